// check_pieces.mjs FOLDER CHROMEDRIVER CHROMIUM TOUCH_PLAYER: do the pieces of the example page go where scripted
// fingers go? FOLDER has the npm packages and gets a picture of the page.
import { spawn } from "node:child_process";
import { join } from "node:path";
import { Browser, TablePage, apart, lineOf, serve, until } from "./browser.mjs";

const [folder, chromedriver, chromium, touchPlayer] = process.argv.slice(2);
const pixel = 1 / 800;

class Player {
  static async start(port) {
    const player = new Player();
    player.process = spawn(touchPlayer, [String(port)], { stdio: ["pipe", "pipe", "inherit"] });
    process.once("exit", () => player.process.kill());
    [player.port] = await lineOf(player.process, /\d+/);
    player.frame = 0;
    return player;
  }
  /** One frame, each touch [id, phase, x, y]. */
  say(...touches) {
    const reported = touches.map(([id, phase, ...surface]) =>
      ({ id, phase, camera_mm: [0, 0, 800], surface, height_mm: 0 }));
    const line = { frame: this.frame, time_us: this.frame++ * 33333, state: "live", touches: reported, hovers: [] };
    this.process.stdin.write(JSON.stringify(line) + "\n");
  }
  /** Fingers go along straight lines, each { id, from, to }, in so many frames. */
  drag(fingers, frames = 10) {
    this.say(...fingers.map(({ id, from }) => [id, "down", ...from]));
    for (let i = 1; i <= frames; ++i) {
      this.say(...fingers.map(({ id, from, to }) =>
        [id, "move", ...from.map((share, axis) => share + (to[axis] - share) * i / frames)]));
    }
  }
  lift(fingers) { this.say(...fingers.map(({ id, to }) => [id, "up", ...to])); }
}

let failures = 0;
const check = (ok, text) => {
  if (ok) return;
  ++failures;
  console.log(`FAILED: ${text}`);
};
const same = (is, should, text) =>
  check(JSON.stringify(is) === JSON.stringify(should), `${text}: ${JSON.stringify(is)}, not ${JSON.stringify(should)}`);

let player = await Player.start(0);
const server = await serve(folder);
const browser = await Browser.open(chromedriver, chromium);
try {
  const page = new TablePage(browser);
  await browser.go(`http://127.0.0.1:${server.address().port}/?table=ws://127.0.0.1:${player.port}`);
  await page.connected();
  const expected = await page.places();
  const pieceGoes = (name, dx, dy) => { expected[name] = [expected[name][0] + dx, expected[name][1] + dy]; };
  const inPlace = (text) =>
    until(`in place: ${text}`, async () => apart(await page.places(), expected, pixel).length === 0);
  const atRest = async (text) => {
    await inPlace(text);
    await until(`no finger: ${text}`, async () => (await page.fingers()) === 0);
    same(apart(await page.places(), expected, pixel), [], `not in place: ${text}`);
    same(await page.held(), [], `held: ${text}`);
  };

  const one = [{ id: 1, from: [0.22, 0.25], to: [0.52, 0.4] }];
  player.drag(one);
  pieceGoes("piece-0", 0.3, 0.15);
  await inPlace("the piece at the finger");
  same(await page.held(), ["piece-0"], "held by one finger");
  player.lift(one);
  await atRest("one finger");

  const two = [{ id: 2, from: [0.8, 0.2], to: [0.7, 0.6] }, { id: 3, from: [0.18, 0.8], to: [0.3, 0.3] }];
  player.drag(two);
  await until("two fingers", async () => (await page.fingers()) === 2);
  await until("two pieces", async () => (await page.held()).length === 2);
  await browser.screenshot(join(folder, "pieces.png"));
  player.lift(two);
  pieceGoes("piece-3", -0.1, 0.4);
  pieceGoes("piece-8", 0.12, -0.5);
  await atRest("two fingers");

  const beside = [{ id: 4, from: [0.03, 0.03], to: [0.2, 0.5] }];
  player.drag(beside);
  player.lift(beside);
  await atRest("a finger beside the pieces");

  const onTop = [{ id: 5, from: [0.52, 0.4], to: [0.52, 0.9] }];
  player.drag(onTop);
  player.lift(onTop);
  pieceGoes("piece-0", 0, 0.5);
  await atRest("the piece that was moved last lies on top");

  player.drag([{ id: 6, from: [0.52, 0.87], to: [0.6, 0.87] }]);
  pieceGoes("piece-0", 0.08, 0);
  await until("the finger is shown", async () => (await page.held()).length === 1);
  await inPlace("the piece that it dragged");
  player.process.kill("SIGKILL");
  await until("the page says so", async () => (await page.status()).startsWith("Waiting for the table"));
  await atRest("the table went away under a finger");
  player = await Player.start(player.port);
  await page.connected();
  const again = [{ id: 1, from: [0.6, 0.85], to: [0.5, 0.85] }];
  player.drag(again);
  player.lift(again);
  pieceGoes("piece-0", -0.1, 0);
  await atRest("the table came back");

  const errors = (await browser.log()).filter(({ message }) => !/WebSocket connection|favicon/.test(message));
  same(errors, [], "errors of the page");
} finally {
  player.process.kill();
  await browser.close();
  server.close();
}
console.log(`${failures} differences`);
process.exit(failures === 0 ? 0 : 1);
