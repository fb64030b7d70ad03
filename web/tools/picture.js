// Takes the picture of the page that the README and the book show; the page has been built (tools/build.js):
//
//     node web/tools/picture.js

import { resolve } from "node:path";
import { chromium } from "playwright-core";
import { browserProgram, limits, settled } from "../test/browser.js";
import { page as folder, top } from "./places.js";
import { serve } from "./serve.js";

const server = await serve(folder);
const browser = await chromium.launch({ executablePath: browserProgram(), args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 860 } });
await page.goto(`http://localhost:${server.address().port}/`);
await settled(page);
await limits(page);
await page.screenshot({ path: resolve(top, "docs/src/pictures/page.png") });
await browser.close();
server.close();
