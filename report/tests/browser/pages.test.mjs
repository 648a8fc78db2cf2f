// The pages in a browser: node --test report/tests/browser/pages.test.mjs, PROGRAMS the folder of the
// programs, WORK a folder to make the pages and screenshots in.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { open, phone, picture, quit } from "./browser.mjs";
import { hostile, makePages } from "./pages.mjs";

const { PROGRAMS: programs, WORK: work } = process.env;
const at = (name) => join(work, name);
const shots = at("screenshots");

before(() => {
  makePages(programs, work);
  mkdirSync(shots, { recursive: true });
});
after(quit);

function sound({ complaints, requests }) {
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((url) => !/^(file|data|blob):/.test(url)), []);
}

// Labels that are markup stand as text, and do nothing.
async function harmless(page) {
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.evaluate(() => document.title.includes("hit") && !document.title.includes("<")), false);
}

async function saved(page, button) {
  const [download] = await Promise.all([page.waitForEvent("download"), button.click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

test("a scan: points in every colour, layers, keys", async () => {
  await open(at("scan.html"), {}, async (page, kept) => {
    const first = await picture(page);
    assert.ok(first.colours > 300, `${first.colours} colours`);
    const select = page.locator(".view select").first();
    const modes = await select.locator("option").evaluateAll((options) => options.map((option) => option.value));
    assert.deepEqual(modes, ["height", "elevation", "class", "plot", "intensity", "time"]);
    const seen = new Set();
    for (const mode of modes) {
      await select.selectOption(mode);
      await page.waitForTimeout(500);
      seen.add((await picture(page)).sum);
    }
    assert.equal(seen.size, modes.length, "every colouring is another picture");
    for (const layer of ["boxes", "fitted ground", "drone's path", "points"]) {
      const before = (await picture(page)).sum;
      await page.locator(".checks label", { hasText: layer }).locator("input").click();
      await page.waitForTimeout(400);
      assert.notEqual((await picture(page)).sum, before, `${layer} is switched`);
    }
    await page.locator(".checks label", { hasText: "points" }).locator("input").click();
    const before = (await picture(page)).sum;
    await page.locator(".stage canvas").focus();
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("+");
    await page.waitForTimeout(500);
    assert.notEqual((await picture(page)).sum, before, "keys turn the field");
    assert.ok((await page.locator("h1").textContent()).includes(hostile[1]));
    await harmless(page);
    await page.screenshot({ path: join(shots, "scan.png") });
    sound(kept);
  });
});

test("an estimate: a plot is chosen on the map, in the table, by key and in the view", async () => {
  const plots = JSON.parse(readFileSync(at("estimate/plots.geojson"), "utf8")).features;
  await open(at("estimate.html"), {}, async (page, kept) => {
    const details = page.locator(".details");
    for (const [i, plot] of plots.entries()) {
      await page.locator(".map .plot").nth(i).click();
      const text = await details.textContent();
      assert.ok(text.includes(`Plot ${plot.id}`), `${text} names ${plot.id}`);
      const shown = await details.locator("tr", { hasText: /^max/ }).locator("td").nth(1).textContent();
      assert.ok(Math.abs(Number(shown) - plot.properties.height_max_m) < 0.00051, `${shown}, ${plot.properties.height_max_m}`);
    }
    await page.keyboard.press("ArrowLeft");
    assert.ok((await details.textContent()).includes(`Plot ${plots.at(-2).id}`));
    await page.locator(".table tbody tr").nth(2).locator("button").click();
    assert.ok((await details.textContent()).includes(`Plot ${plots[2].id}`));
    assert.ok((await page.locator(".profile h3").textContent()).includes(plots[2].id));
    // A click in the view, where a plot's number stands.
    await page.locator(".stage").scrollIntoViewIfNeeded();
    await page.waitForTimeout(500);
    const label = page.locator(".labels span", { hasText: "P-5" });
    const box = await label.boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height + 6);
    assert.ok((await details.textContent()).includes("Plot P-5"));
    assert.ok((await page.locator(".profile path").count()) > 4);
    for (const measure of ["height", "truth", "error", "interval", "confidence"]) {
      const select = page.locator(".map select").first();
      if ((await select.locator(`option[value=${measure}]`).count()) === 0) continue;
      await select.selectOption(measure);
      assert.ok((await page.locator(".map .plot polygon").first().getAttribute("fill")).startsWith("#"));
    }
    // A height has one colour, whichever are shown.
    const labels = () => page.locator(".profile svg text[font-weight]").evaluateAll((texts) => Object.fromEntries(texts.map((text) => [text.textContent.split(" ")[0], text.getAttribute("fill")])));
    const bars = () => page.locator("#figures figure").first().locator("rect:has(title)").evaluateAll((rects) => Object.fromEntries(rects.map((rect) => [rect.textContent.split(",")[0], rect.getAttribute("fill")])));
    const colours = await bars();
    for (const height of ["max", "mean"]) {
      await page.locator(".map select").nth(1).selectOption(height);
      for (const [name, colour] of Object.entries(await labels())) assert.equal(colour, colours[name], name);
    }
    await page.locator("#figures .chips label").filter({ hasText: /^max$/ }).locator("input").click();
    for (const [name, colour] of Object.entries(await bars())) assert.equal(colour, colours[name], name);
    await harmless(page);
    await page.screenshot({ path: join(shots, "estimate.png"), fullPage: true });
    sound(kept);
  });
});

for (const [name, least] of [["estimate", [5, 6, 6]], ["suite/report", [9, 10, 12]], ["sweep/report", [1, 1, 2]]]) test(`${name}: every figure and table is saved, and its files open`, async () => {
  await open(at(`${name}.html`), {}, async (page, kept) => {
    const counts = { svg: 0, png: 0, csv: 0 };
    for (const button of await page.locator(".saves button").all()) {
      const { name, bytes } = await saved(page, button);
      assert.match(name, /^[a-z0-9-]+\.(svg|png|csv)$/);
      const kind = name.split(".")[1];
      ++counts[kind];
      if (kind === "png") {
        assert.equal(bytes.subarray(1, 4).toString(), "PNG");
        assert.ok(bytes.readUInt32BE(16) > 600, "as wide as print wants");
      } else if (kind === "svg") {
        const sane = await page.evaluate((text) => {
          const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
          return parsed.querySelector("parsererror") === null && parsed.querySelectorAll("script, img").length === 0 && !text.includes("NaN");
        }, bytes.toString());
        assert.ok(sane, name);
      } else {
        const rows = bytes.toString().trim().split("\r\n");
        assert.ok(rows.length > 1 && rows[0].includes(","), name);
        const head = rows[0].split(",");
        assert.equal(new Set(head).size, head.length, rows[0]);
        assert.ok(!bytes.includes("NaN"), name);
      }
    }
    assert.ok(Object.values(counts).every((count, i) => count >= least[i]), JSON.stringify(counts));
    sound(kept);
  });
});

test("a suite: a farm of each case, figures, tables that sort", async () => {
  await open(at("suite/report.html"), {}, async (page, kept) => {
    assert.ok(Number(await page.evaluate(() => document.documentElement.dataset.interactive)) > 0);  // report/speed.mjs measures it
    const tabs = page.locator("[role=tab]");
    assert.equal(await tabs.count(), 3);
    for (let i = 0; i < 3; ++i) {
      await tabs.nth(i).click();
      await page.waitForSelector(".field[data-ready]");
      await page.waitForTimeout(600);
      assert.ok((await picture(page)).colours > 300);
      assert.ok((await page.locator(".map .plot").count()) > 0);
    }
    assert.equal(await page.locator("#figures figure svg").count(), 4);
    // The table of the page has the numbers of table.csv.
    const rows = readFileSync(at("suite/table.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    const rmse = rows[0].indexOf("rmse_cm");
    const row = rows.find(([, of, method, truth]) => of === "one" && method === "oracle-ground" && truth === "height_max_m");
    const cells = page.locator("#tables .table").first().locator("tbody tr", { hasText: "oracle-ground" }).filter({ hasText: "one" }).locator("td");
    assert.equal(Number((await cells.nth(5).textContent()).replace("−", "-")).toFixed(2), Number(row[rmse]).toFixed(2));
    const table = page.locator("#tables .table").first();
    await table.locator("th button", { hasText: "RMSE" }).click();
    const values = await table.locator("tbody td:nth-child(6)").allTextContents();
    const numbers = values.filter((value) => value !== "–").map(Number);
    assert.deepEqual(numbers, [...numbers].sort((a, b) => b - a));
    await page.locator("#figures select").first().selectOption("height_mean_m");
    assert.ok((await page.locator("#tables h3").first().textContent()).includes("mean plant height"));
    await page.screenshot({ path: join(shots, "suite.png"), fullPage: true });
    sound(kept);
  });
});

test("the paper's steps: boxes before and after voting, ground inliers", async () => {
  await open(at("suite/report.html"), {}, async (page, kept) => {
    const field = JSON.parse(await page.locator("#report").textContent()).fields[0];
    const voting = page.locator("figure", { has: page.locator("h3", { hasText: "Boxes before and after voting: dhami2020" }) });
    const [steps] = field.workings;
    assert.equal(steps.method, "dhami2020");
    assert.ok(steps.clusters.length > 0 && steps.plots.length > 0);
    // The true plots stand in both panels.
    assert.equal(await voting.locator("polygon").count(), steps.clusters.length + steps.plots.length + 2 * field.true_boxes.length);
    assert.ok((await voting.locator("path").first().getAttribute("d")).length > 10_000, "points above the ground");
    const inliers = page.locator("figure", { has: page.locator("h3", { hasText: "Ground inliers of plots: dhami2020 true-boxes" }) });
    const { bytes } = await saved(page, inliers.locator("button", { hasText: "CSV" }));
    const rows = bytes.toString().trim().split("\r\n").slice(1).map((row) => row.split(",").map(Number));
    const { slope, tolerance } = field.workings[1].planes[0];
    for (const [, , , above, ground] of rows) {
      const off = Math.abs(above) / Math.hypot(1, ...slope);
      if (Math.abs(off - tolerance) > 2e-3) assert.equal(ground, off < tolerance ? 1 : 0);
    }
    assert.ok(rows.some((row) => row[4] === 1) && rows.some((row) => row[4] === 0));
    await voting.screenshot({ path: join(shots, "voting.png") });
    await inliers.screenshot({ path: join(shots, "inliers.png") });
    sound(kept);
  });
});

test("a sweep: contours, the flight that is needed, limits of one's own", async () => {
  await open(at("sweep/report.html"), {}, async (page, kept) => {
    const figure = page.locator("#figures figure");
    assert.equal(await figure.locator("svg circle").count() > 0, true);
    assert.ok((await figure.locator("svg path").count()) > 1, "bands");
    const rows = readFileSync(at("sweep/sweep.csv"), "utf8").trim().split("\n").map((line) => line.split(","));
    const at_ = (name) => rows[0].indexOf(name);
    const own = rows.filter((row) => row[at_("method")].startsWith("lattice/mean"));
    assert.equal(own.length, 8);
    const best = own.reduce((a, b) => (Number(b[at_("flight_s")]) < Number(a[at_("flight_s")]) ? b : a));
    const said = page.locator(".answer");
    assert.ok((await said.textContent()).includes(`altitude ${best[0]} m, speed ${best[1]} m/s, sensor ${best[2]};`), await said.textContent());
    const cells = await page.locator("#tables tbody tr").first().locator("td").allTextContents();
    // Rounded twice: the page's data to 0.001 cm, what it shows to 0.01 cm.
    assert.ok(Math.abs(Number(cells[3]) - Number(own[0][at_("rmse_cm")])) < 0.0056, cells[3]);
    await page.locator("input[type=number]").first().fill("0.001");
    assert.ok((await said.textContent()).startsWith("None"));
    await page.locator("#figures select").first().selectOption("found");
    assert.ok((await figure.locator("h3").textContent()).startsWith("Plots found"));
    await page.screenshot({ path: join(shots, "sweep.png"), fullPage: true });
    sound(kept);
  });
});

test("a phone in the dark: nothing sticks out", async () => {
  for (const name of ["scan", "estimate", "suite/report", "sweep/report"]) {
    await open(at(`${name}.html`), { size: phone, colours: "dark" }, async (page, kept) => {
      const [inner, outer] = await page.evaluate(() => [window.innerWidth, document.documentElement.scrollWidth]);
      assert.ok(outer <= inner, `${name}: ${outer} of ${inner} pixels`);
      assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(13, 17, 23)");
      await page.screenshot({ path: join(shots, `${name.replace("/", "-")}-phone.png`), fullPage: true });
      sound(kept);
    });
  }
});
