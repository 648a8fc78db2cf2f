// Debian's Chromium, headless, one for all pages of a program, each page in a profile of its own; what a page complains of
// and asks for is kept.
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const flags = [
  "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync"];

export const desktop = { width: 1400, height: 900 };
export const phone = { width: 390, height: 844 };

let browser;
const running = () => (browser ??= chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args: flags }));

// Ends the browser, without which a program does not end.
export async function quit() {
  await (await browser)?.close();
  browser = undefined;
}

// Opens a page, hands it to `use`, and closes it whatever happens.
export async function open(file, { size = desktop, colours = "light" }, use) {
  const context = await (await running()).newContext({ viewport: size, colorScheme: colours, acceptDownloads: true });
  try {
    const page = await context.newPage();
    const complaints = [];
    const requests = [];
    page.on("console", (message) => message.type() === "error" && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(String(error)));
    page.on("dialog", (dialog) => {
      complaints.push(`dialog: ${dialog.message()}`);
      void dialog.dismiss();
    });
    page.on("request", (request) => requests.push(request.url()));
    await page.goto(pathToFileURL(file).href);
    await page.waitForSelector("[data-ready]", { timeout: 60_000 });
    await page.waitForTimeout(700);
    await use(page, { complaints, requests });
  } finally {
    await context.close();
  }
}

// How many colours a canvas shows, and a number that changes with the picture.
export const picture = (page) => page.evaluate(() => {
  const canvas = document.querySelector(".stage canvas");
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [200, 150];
  const context = copy.getContext("2d");
  context.drawImage(canvas, 0, 0, 200, 150);
  const bytes = context.getImageData(0, 0, 200, 150).data;
  const colours = new Set();
  let sum = 0;
  for (let i = 0; i < bytes.length; i += 4) {
    colours.add((bytes[i] << 16) | (bytes[i + 1] << 8) | bytes[i + 2]);
    sum = (sum * 31 + bytes[i] + 7 * bytes[i + 1] + 13 * bytes[i + 2]) % 1_000_000_007;
  }
  return { colours: colours.size, sum };
});
