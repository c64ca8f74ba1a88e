// check_simulation.mjs FOLDER CHROMEDRIVER CHROMIUM TOUCHSTONE: do the pieces of the example page go where the hands
// of the simulated table go, by the event log of the same run? FOLDER has the npm packages and gets log and picture.
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";
import { Pieces, twelvePieces } from "../../../examples/web/pieces.js";
import { Browser, TablePage, apart, serve } from "./browser.mjs";

const [folder, chromedriver, chromium, touchstone] = process.argv.slice(2);
const pixel = 1 / 800;

function freePort() {
  const server = createServer();
  return new Promise((found) => server.listen(0, "127.0.0.1", () => {
    const { port } = server.address();
    server.close(() => found(port));
  }));
}

/** Where the log says that the pieces are at the end, and how many touches took one. */
function piecesOfLog(file) {
  const pieces = new Pieces(twelvePieces());
  let drags = 0;
  for (const line of readFileSync(file, "utf8").trim().split("\n")) {
    for (const { id, phase, surface } of JSON.parse(line).touches) {
      if (phase === "down") {
        pieces.down(id, ...surface);
        if (pieces.grips.has(id)) ++drags;
      }
      if (phase !== "up") pieces.move(id, ...surface);
      if (phase === "up") pieces.up(id);
    }
  }
  return { drags, places: Object.fromEntries(pieces.pieces.map((piece) => [piece.name, [piece.x, piece.y]])) };
}

const port = await freePort();
const [config, events] = [join(folder, "table.toml"), join(folder, "events.jsonl")];
writeFileSync(config, `[websocket]\nenabled = true\nport = ${port}\n[tuio]\nenabled = false\n`);
const server = await serve(folder);
const browser = await Browser.open(chromedriver, chromium);
let failed = false;
try {
  const page = new TablePage(browser);
  await browser.go(`http://127.0.0.1:${server.address().port}/?table=ws://127.0.0.1:${port}`);
  const table = spawn(touchstone, ["run", "--display", "headless", "--pace", "live", "--config", config, "--events", events,
    "--sensor", "sim:flat?hands=2&seed=4&empty=4&frames=570"], { stdio: ["ignore", "inherit", "inherit"] });
  process.once("exit", () => table.kill());
  const ended = new Promise((end) => table.on("exit", end));
  await page.connected();
  const before = await page.places();
  const status = await ended;
  const { drags, places } = piecesOfLog(events);
  const moved = apart(places, before, pixel), wrong = apart(await page.places(), places, pixel);
  await browser.screenshot(join(folder, "simulation.png"));
  console.log(`${drags} touches took a piece, ${moved.length} pieces were moved; elsewhere: ${wrong.join(" ") || "none"}`);
  failed = status !== 0 || moved.length < 2 || wrong.length > 0;
} finally {
  await browser.close();
  server.close();
}
process.exit(failed ? 1 : 0);
