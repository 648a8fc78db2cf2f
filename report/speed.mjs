// How fast a report page is: node report/speed.mjs PAGE. When it can be used, when all of its points are there, and how
// long a picture takes while the field turns (milliseconds).
import { open, quit } from "./tests/browser/browser.mjs";

await open(process.argv[2], {}, async (page) => {
  const numbers = await page.evaluate(async () => {
    const canvas = document.querySelector(".stage canvas");
    const spent = [];
    for (let i = 0, last = performance.now(); i < 100; ++i) {
      canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
      await new Promise((drawn) => requestAnimationFrame(drawn));
      const now = performance.now();
      spent.push(now - last);
      last = now;
    }
    spent.sort((a, b) => a - b);
    return { interactive: Number(document.documentElement.dataset.interactive), all_points: Number(document.querySelector(".field").dataset.ready), turning_median: spent[50], turning_95: spent[95] };
  });
  console.log(JSON.stringify(numbers, (_, value) => (typeof value === "number" ? Math.round(value) : value)));
});
await quit();
