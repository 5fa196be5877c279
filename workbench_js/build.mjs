// Bundles the scripts into the package; the result is checked in, so that users need no node.
// Its first line names the sources by their hash, so that a test can tell when it is out of date.
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { build } from "esbuild";

const hash = createHash("sha256");
for (const name of [...readdirSync("src").sort().map((n) => `src/${n}`), "package-lock.json"]) {
  hash.update(name).update(readFileSync(name));
}

await build({
  entryPoints: ["src/index.js"],
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  charset: "utf8",
  legalComments: "eof",
  banner: { js: `// made by make workbench-js from sources ${hash.digest("hex")}` },
  loader: { ".css": "text" },
  outfile: "../src/ncscope/views/workbench/static/dist/index.js",
  logLevel: "info",
});
