// check.mjs TUIO_REPLAY FOLDER: does the tuio-client package see the contacts that the event log has? Three processes
// one after the other, the first two killed; the client lives through all of them.
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { pathToFileURL } from "node:url";

const [replay, folder] = process.argv.slice(2);
// The packages are in FOLDER, this file is not; the main file that tuio-client names cannot be imported.
const modules = join(folder, "node_modules");
const { Tuio11Client, TuioReceiver } = await import(pathToFileURL(join(modules, "tuio-client/dist/tuio-client.es.js")));
const osc = createRequire(join(modules, "/"))("osc");

class UdpReceiver extends TuioReceiver {
  connect() {
    this.port = new osc.UDPPort({ localAddress: "127.0.0.1", localPort: 0 });
    this.port.on("message", (message) => this.onOscMessage(message));
    this.port.open();
    return new Promise((ready) => this.port.on("ready", () => ready(this.port.socket.address().port)));
  }
  disconnect() { this.port.close(); }
}

/** Contacts as lists of places, and whether each has ended; fed alike by the client and by the log. */
class Contacts {
  constructor() { this.all = []; this.live = new Map(); }
  add(id, place) {
    const contact = { places: [place], ended: false };
    this.all.push(contact);
    this.live.set(id, contact);
  }
  move(id, place) {
    const places = this.live.get(id).places;
    if (places.at(-1) !== place) places.push(place);
  }
  end(id) {
    this.live.get(id).ended = true;
    this.live.delete(id);
  }
}

const place = (x, y) => `${Math.fround(x)} ${Math.fround(y)}`;

function contactsOfLog(path) {
  const contacts = new Contacts();
  for (const line of readFileSync(path, "utf8").trim().split("\n")) {
    for (const { id, phase, surface } of JSON.parse(line).touches) {
      if (phase === "down") contacts.add(id, place(...surface));
      if (phase === "move") contacts.move(id, place(...surface));
      if (phase === "up") contacts.end(id);
    }
  }
  return contacts;
}

/** Finger 1 drags and is still now and then, 2 taps for one frame, 3 within a frame, 4 for two; all come again. */
function script(run, frames) {
  const share = (value) => Math.round(value * 1e5) / 1e5;
  const lines = [];
  for (let frame = 0; frame < frames; ++frame) {
    const touches = [];
    const touch = (id, phase, u) => {
      const surface = [share(u), share(0.1 * id + 0.01 * run)];
      touches.push({ id, phase, camera_mm: [0, 0, 800], surface, height_mm: 0 });
    };
    const [long, short] = [frame % 40, frame % 10];
    if (long < 35) touch(1, long === 0 ? "down" : long === 34 ? "up" : "move", 0.2 + 0.01 * Math.floor(long / 3));
    if (short === 2) touch(2, "down", 0.3);
    if (short === 3) touch(2, "up", 0.3);
    if (short === 5) { touch(3, "down", 0.4); touch(3, "up", 0.4); }
    if (short === 6) touch(4, "down", 0.5);
    if (short === 7) touch(4, "move", 0.51);
    if (short === 8) touch(4, "up", 0.51);
    lines.push(JSON.stringify({ frame, time_us: frame * 33333, state: "live", touches, hovers: [] }));
  }
  return lines.join("\n") + "\n";
}

const receiver = new UdpReceiver();
const client = new Tuio11Client(receiver);
const port = await receiver.connect();
let seen = new Contacts();
client.addTuioListener({
  addTuioCursor: (c) => seen.add(c.sessionId, place(c.position.x, c.position.y)),
  updateTuioCursor: (c) => seen.move(c.sessionId, place(c.position.x, c.position.y)),
  removeTuioCursor: (c) => seen.end(c.sessionId),
  refresh: () => {},
});

let failures = 0;
let contacts = 0;
const check = (ok, text) => { if (!ok) { ++failures; console.log(`FAILED: ${text}`); } };

let left = new Map();
const runs = [{ frames: 109, killed: true }, { frames: 21, killed: true }, { frames: 121, killed: false }];
for (const [run, { frames, killed }] of runs.entries()) {
  const [input, events] = [join(folder, `script-${run}.jsonl`), join(folder, `events-${run}.jsonl`)];
  writeFileSync(input, script(run, frames));
  seen = new Contacts();
  const before = [...left.values()];
  seen.live = left;
  const process = spawn(replay, [String(port), input, events, ...(killed ? ["--killed"] : [])], { stdio: "inherit" });
  const signal = await new Promise((ended) => process.on("exit", (_, by) => ended(by)));
  check(signal === (killed ? "SIGKILL" : null), `run ${run} ended by ${signal}`);
  await sleep(100);
  const logged = contactsOfLog(events);
  contacts += logged.all.length;
  if (!killed) for (const id of [...logged.live.keys()]) logged.end(id);
  check(before.every((contact) => contact.ended), `run ${run} left cursors of the run before`);
  const [is, should] = [JSON.stringify(seen.all), JSON.stringify(logged.all)];
  check(is === should, `run ${run}: the client saw\n${is}\nthe log has\n${should}`);
  left = new Map(seen.live);
}
check(left.size === 0, "cursors are left after a clean end");
receiver.disconnect();
console.log(`${contacts} contacts in three processes, ${failures} differences`);
process.exit(failures === 0 && contacts > 0 ? 0 : 1);
