// A picture of a report page, for the docs: node report/picture.mjs PAGE PNG WIDTH HEIGHT [SELECTOR [PLOT]]; with a
// selector that part of the page alone; with a plot's id that plot is chosen first.
import { open, quit } from "./tests/browser/browser.mjs";

const [file, png, width, height, selector, plot] = process.argv.slice(2);
await open(file, { size: { width: Number(width), height: Number(height) } }, async (page) => {
  if (plot) await page.locator(`.map [data-plot="${plot}"]`).click();
  await page.evaluate(() => {
    document.querySelector("nav")?.style.setProperty("position", "static");
    window.scrollTo(0, 0);
    document.activeElement?.blur();
  });
  await page.waitForTimeout(2000);
  await (selector ? page.locator(selector).first() : page).screenshot({ path: png });
});
await quit();
