import { Tuio11Client } from "tuio-client";
import { Pieces, twelvePieces } from "./pieces.js";
import { TableReceiver } from "./table_receiver.js";

const url = new URLSearchParams(location.search).get("table") ?? "ws://127.0.0.1:3343";
const table = document.getElementById("table");
const status = document.getElementById("status");

const pieces = new Pieces(twelvePieces());
const fingers = new Map();  // their rings, by session

function addElement(className) {
  const element = document.createElement("div");
  element.className = className;
  table.append(element);
  return element;
}

function place(element, x, y) {
  element.style.setProperty("--x", x);
  element.style.setProperty("--y", y);
}

const elements = new Map(pieces.pieces.map((piece) => {
  const element = addElement("piece");
  element.id = piece.name;
  element.style.setProperty("--colour", piece.colour);
  element.style.setProperty("--width", piece.width);
  element.style.setProperty("--height", piece.height);
  return [piece, element];
}));

function draw() {
  for (const [i, piece] of pieces.pieces.entries()) {
    const element = elements.get(piece);
    element.style.zIndex = i;
    element.classList.toggle("held", pieces.isHeld(piece));
    place(element, piece.x, piece.y);
  }
}

function follow(cursor) {
  const { x, y } = cursor.position;
  if (!fingers.has(cursor.sessionId)) {
    const ring = addElement("finger");
    ring.style.zIndex = elements.size;
    fingers.set(cursor.sessionId, ring);
    pieces.down(cursor.sessionId, x, y);
  }
  pieces.move(cursor.sessionId, x, y);
  place(fingers.get(cursor.sessionId), x, y);
}

function lift(cursor) {
  pieces.up(cursor.sessionId);
  fingers.get(cursor.sessionId)?.remove();
  fingers.delete(cursor.sessionId);
}

const receiver = new TableReceiver(url, (connected) => {
  status.textContent = connected ? "Touch the pieces" : `Waiting for the table at ${url}`;
  status.className = connected ? "connected" : "";
});
new Tuio11Client(receiver).addTuioListener({
  addTuioCursor: follow,
  updateTuioCursor: follow,
  removeTuioCursor: lift,
  refresh: draw,
});
draw();
receiver.connect();
