import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";

// Puts script and style into the page, which is then one file; a policy in it allows this script alone,
// and no network.
function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle(_, bundle) {
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("no index.html");
      let script = "";
      let style = "";
      for (const [name, part] of Object.entries(bundle)) {
        if (part.type === "chunk") script += part.code;
        else if (name.endsWith(".css")) style += part.source;
        if (name !== "index.html") delete bundle[name];
      }
      script = "\n" + script.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--").trim() + "\n";
      const hash = createHash("sha256").update(script).digest("base64");
      const license = readFileSync("node_modules/three/LICENSE", "utf8").trim();
      const policy =
        `default-src 'none'; script-src 'sha256-${hash}'; style-src 'unsafe-inline'; img-src data: blob:; ` +
        "base-uri 'none'; form-action 'none'";
      page.source = String(page.source)
        .replace(/<script type="module"[^>]*><\/script>\n?/g, "")
        .replace(/<link rel="stylesheet"[^>]*>\n?/g, "")
        .replace("<html", () => `<!--\nPlotscan's report pages, Apache License 2.0. They contain three.js:\n\n${license}\n-->\n<html`)
        .replace("</title>", () => `</title>\n<meta http-equiv="Content-Security-Policy" content="${policy}">\n<style>${style.trim()}</style>`)
        .replace("</body>", () => `<script type="module">${script}</script>\n</body>`);
    },
  };
}

export default defineConfig({
  plugins: [oneFile()],
  build: { target: "es2022", modulePreload: false, cssCodeSplit: false, reportCompressedSize: false },
  test: { include: ["tests/*.test.ts"] },
} as Parameters<typeof defineConfig>[0]);
