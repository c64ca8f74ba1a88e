// Chromium without a screen, driven through chromedriver, and a server for the example page.
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join, normalize } from "node:path";
import { setTimeout as sleep } from "node:timers/promises";
import { fileURLToPath } from "node:url";

const types = { ".html": "text/html", ".css": "text/css", ".js": "text/javascript" };
const longestWaitMs = 30_000;

/** The first value of `ask` that is true; throws Error where none comes. */
export async function until(what, ask) {
  for (const start = Date.now(); Date.now() - start < longestWaitMs; await sleep(30)) {
    const answer = await ask();
    if (answer) return answer;
  }
  throw new Error(`waited in vain: ${what}`);
}

/** The first line of a process that `pattern` finds. */
export function lineOf(process, pattern) {
  return new Promise((found, failed) => {
    let text = "";
    process.stdout.on("data", (data) => {
      text += data;
      const match = text.match(pattern);
      if (match) found(match);
    });
    process.on("exit", (status) => failed(new Error(`ended with ${status} before it said ${pattern}: ${text}`)));
  });
}

/** Serves the example, and node_modules from `folder`, on a port of this machine. */
export function serve(folder) {
  const page = fileURLToPath(new URL("../../../examples/web", import.meta.url));
  const server = createServer((request, response) => {
    const path = normalize(new URL(request.url, "http://localhost").pathname);
    const file = join(path.startsWith("/node_modules/") ? folder : page, path === "/" ? "index.html" : path);
    try {
      const bytes = readFileSync(file);
      response.writeHead(200, { "Content-Type": types[extname(file)] ?? "application/octet-stream" }).end(bytes);
    } catch {
      response.writeHead(404).end();
    }
  });
  return new Promise((ready) => server.listen(0, "127.0.0.1", () => ready(server)));
}

export class Browser {
  static async open(chromedriver, chromium) {
    const browser = new Browser();
    browser.driver = spawn(chromedriver, ["--port=0"], { stdio: ["ignore", "pipe", "inherit"] });
    process.once("exit", () => browser.driver.kill());
    const [, port] = await lineOf(browser.driver, /successfully on port (\d+)/);
    browser.url = `http://127.0.0.1:${port}/session`;
    const args = ["--headless=new", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1280,800"];
    if (process.getuid() === 0) args.push("--no-sandbox");
    const options = { "goog:chromeOptions": { binary: chromium, args }, "goog:loggingPrefs": { browser: "ALL" } };
    const { sessionId } = await browser.post("", { capabilities: { alwaysMatch: options } });
    browser.url += `/${sessionId}`;
    return browser;
  }

  async post(command, body) {
    return Browser.value(await fetch(this.url + command, { method: "POST", body: JSON.stringify(body) }));
  }
  static async value(response) {
    const { value } = await response.json();
    if (!response.ok) throw new Error(`${value.error}: ${value.message}`);
    return value;
  }

  go(url) { return this.post("/url", { url }); }
  ask(script) { return this.post("/execute/sync", { script, args: [] }); }
  /** Lines of the page's console. */
  log() { return this.post("/se/log", { type: "browser" }); }
  async screenshot(file) {
    const picture = await Browser.value(await fetch(this.url + "/screenshot"));
    writeFileSync(file, Buffer.from(picture, "base64"));
  }
  close() { return fetch(this.url, { method: "DELETE" }); }
}

/** The example page: what it shows, in shares of its window. */
export class TablePage {
  constructor(browser) { this.browser = browser; }

  status() { return this.browser.ask("return document.getElementById('status').textContent"); }
  connected() { return until("the page is connected", async () => (await this.status()) === "Touch the pieces"); }
  fingers() { return this.browser.ask("return document.querySelectorAll('.finger').length"); }
  held() { return this.browser.ask("return [...document.querySelectorAll('.held')].map((piece) => piece.id).sort()"); }
  /** Middles of the pieces by name, from where they are drawn. */
  places() {
    return this.browser.ask(`return Object.fromEntries([...document.querySelectorAll('.piece')].map((piece) => {
      const box = piece.getBoundingClientRect();
      return [piece.id, [(box.left + box.right) / 2 / innerWidth, (box.top + box.bottom) / 2 / innerHeight]];
    }))`);
  }
}

/** The names of what lies more than `most` apart in two lists of places. */
export function apart(places, others, most) {
  return Object.keys(places).filter((name) => places[name].some((share, i) => Math.abs(share - others[name][i]) > most));
}
