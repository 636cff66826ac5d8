// node bundle.mjs OUTPUT: walk.html with its style and its scripts in it, three.js among them. Enfilade puts a building in the
// places of the marks <!--title-->, <!--model--> and <!--data-->.
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const { outputFiles } = await build({
  entryPoints: ["main.js"], bundle: true, minify: true, write: false, format: "iife", target: "es2022", charset: "utf8",
  legalComments: "eof", // three.js's licence stays in the page
});
const inElement = (text, name) => text.replaceAll(new RegExp(`</(?=${name})`, "gi"), "<\\/");
const script = inElement(outputFiles[0].text, "script");
const page = readFileSync("walk.html", "utf8")
  .replace("/*style*/", () => readFileSync("walk.css", "utf8"))
  .replace("/*script*/", () => script);
writeFileSync(process.argv[2], page);
