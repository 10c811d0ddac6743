// The page that plays, tried in a headless browser: node tests/web/webtest.js BROWSER. It serves build/web by itself and
// leaves screenshots in build/web-shots. Prints `ok` and `FAIL` lines and a count.
"use strict";
const fs = require("fs");
const os = require("os");
const path = require("path");
const puppeteer = require(path.resolve("build/npm/node_modules/puppeteer-core"));
const { serve } = require("./serve.js");

const SHOTS = "build/web-shots";
const SLOW = 60000;  // milliseconds; a busy machine may need them

let passed = 0, failed = 0;
function ok(name, good, said) {
	console.log((good ? "ok " : "FAIL ") + name + (good || said === undefined ? "" : ": " + said));
	good ? ++passed : ++failed;
}

const wait = (milliseconds) => new Promise((resolve) => setTimeout(resolve, milliseconds));

async function main() {
	fs.rmSync(SHOTS, { recursive: true, force: true });
	fs.mkdirSync(SHOTS, { recursive: true });
	const server = await serve("build/web", 0);
	const home = `http://127.0.0.1:${server.address().port}/`;
	const profile = fs.mkdtempSync(path.join(os.tmpdir(), "fbweb"));
	const browser = await puppeteer.launch({
		executablePath: process.argv[2], headless: true, userDataDir: profile,
		args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
			"--disable-component-update", "--disable-sync"],
	});
	try {
		await tryPage(browser, home);
	} finally {
		await browser.close();
		server.close();
		fs.rmSync(profile, { recursive: true, force: true });
	}
}

async function tryPage(browser, home) {
	const page = await browser.newPage();
	const errors = [], outside = [];
	page.on("console", (message) => {
		// The test itself reads the canvas often.
		if ((message.type() === "error" || message.type() === "warn") && !message.text().includes("willReadFrequently"))
			errors.push(message.text());
	});
	page.on("pageerror", (error) => errors.push(error.message));
	page.on("requestfailed", (request) => errors.push("failed: " + request.url()));
	page.on("response", (response) => {
		if (response.status() >= 400)
			errors.push(response.status() + " " + response.url());
	});
	page.on("request", (request) => {
		const url = request.url();
		if (!url.startsWith(home) && !url.startsWith("blob:" + home) && !url.startsWith("data:"))
			outside.push(url);
	});
	await page.setViewport({ width: 1200, height: 900 });

	const shot = async (name) => {
		await page.evaluate(() => window.scrollTo(0, 0));
		await page.screenshot({ path: `${SHOTS}/${name}.png`, fullPage: true });
	};
	const text = (id) => page.$eval("#" + id, (element) => element.textContent);
	// What the canvas shows: how many of its pixels are not black, how many colours they have, and a sum over them.
	const picture = () => page.$eval("#canvas", (canvas) => {
		const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
		const colours = new Set();
		let lit = 0, sum = 0, grey = 0;
		for (let i = 0; i < data.length; i += 4) {
			const [r, g, b] = [data[i], data[i + 1], data[i + 2]];
			if (r + g + b > 0) {
				++lit;
				grey += Math.max(r, g, b) - Math.min(r, g, b) <= 8 ? 1 : 0;
				colours.add(r << 16 | g << 8 | b);
			}
			sum = (sum * 31 + r + 3 * g + 7 * b) >>> 0;
		}
		return { width: canvas.width, height: canvas.height, lit, grey, colours: colours.size, sum };
	});
	const until = async (what, limit = SLOW) => {
		for (const end = Date.now() + limit; Date.now() < end; await wait(100)) {
			if (await what())
				return true;
		}
		return false;
	};
	const playing = (limit) => until(async () => {
		const now = await picture();
		return now.width === 320 && now.height === 200 && now.lit > 1000;
	}, limit);
	const moves = async () => {
		const { sum } = await picture();
		return until(async () => (await picture()).sum !== sum, 20000);
	};
	const ended = () => until(() => page.$eval("#play", (button) => !button.hidden));
	const rows = () => page.$$eval("#runs tbody tr", (list) => list.map((row) => [...row.cells].map((cell) => cell.textContent)));
	const statistics = async () => Object.fromEntries((await text("stats")).split("\n").map((line) => line.trim().split(": ")));

	// ---- It loads
	await page.goto(home, { waitUntil: "load" });
	const scenes = fs.readdirSync("build/web/scenes").map((name) => name.replace(".FB", ""));
	const buttons = await page.$$eval("#scenes button", (list) => list.map((button) => button.dataset.scene));
	ok("a button for each scene", scenes.length > 0 && scenes.every((name) => buttons.includes(name)), buttons.join(" "));
	ok("each with its picture", await until(() => page.$$eval("#scenes img",
		(list) => list.every((image) => image.complete && image.naturalWidth === 320 && image.naturalHeight === 240))));
	ok("the emulator's version and licence are named", /js-dos 8\.[0-9.]+, licence GPL-2\.0/.test(await text("canvas") +
		await page.$eval("footer", (footer) => footer.textContent)));
	ok("the first picture stands there before it plays", await until(async () => (await picture()).lit > 5000));
	ok("the text is that of the four spheres", /^sphere red +size 20/m.test(await page.$eval("#text", (area) => area.value)));
	await shot("loaded");

	// ---- One click plays
	await page.click("#play");
	ok("one click plays", await playing());
	ok("the picture moves", await moves());
	ok("in colour", await until(async () => (await picture()).colours > 60, 5000));
	await shot("playing");
	ok("ten seconds later the program's statistics are there", await until(async () => (await rows()).length === 1));
	const first = (await rows())[0] ?? [];
	ok("of the four spheres on a 486DX2-66", first[0] === "FOUR" && first[1] === "486DX2-66" && first[3] === "1.15",
		first.join(" | "));
	const stats = await statistics();
	ok("the report's seeds", stats["seeds"] === "2496" && stats["oversampled seeds"] === "2480", JSON.stringify(stats));
	ok("frames a second are those of the statistics", Number(first[2]) > 1 && Math.abs(Number(first[2]) - Number(stats.fps)) <= 0.05,
		first[2] + " and " + stats.fps);
	ok("and stand beside the report's figure", (await text("figure")).includes(Number(stats.fps).toFixed(1) +
		" frames a second on a 486DX2-66; the report measured 1.15"), await text("figure"));
	ok("then it plays on", await moves());
	await page.click("#stop");
	ok("Stop ends it", await ended());

	// ---- Switches
	await page.click("#grey");
	await page.click("#play");
	await playing();
	ok("/G: one colour", await until(async () => {
		const { lit, grey } = await picture();
		return lit > 1000 && grey === lit;
	}, 20000), JSON.stringify(await picture()));
	await page.click("#printed");
	ok("/P plays", await until(async () => (await text("status")).startsWith("Playing")) && await playing() && await moves());
	ok("the link holds the switches", /grey=1/.test(page.url()) && /printed=1/.test(page.url()), page.url());
	await page.click("#stop");
	await ended();
	const asPrinted = (await rows()).find((row) => row[0] === "FOUR /G /P");
	ok("/G /P has its row", asPrinted !== undefined && Number(asPrinted[2]) < Number(first[2]), JSON.stringify(await rows()));
	await page.click("#grey");
	await page.click("#printed");

	// ---- Machines
	await page.click("#machine-386");
	ok("a 386 plays", await playing() && await moves());
	ok("and is slower", await until(async () => (await rows()).some((row) => row[0] === "FOUR" && row[1] === "386DX-40" &&
		Number(row[2]) > 0 && Number(row[2]) < Number(first[2]) && row[3] === "\u2013")), JSON.stringify(await rows()));
	ok("the report has no figure for it", (await text("figure")).includes("no figure"), await text("figure"));
	await page.click("#machine-p75");
	ok("a Pentium is faster", await until(async () => (await rows()).some((row) => row[1] === "Pentium 75" && row[3] === "2.95" &&
		Number(row[2]) > Number(first[2]))), JSON.stringify(await rows()));
	await shot("machines");
	await page.click("#machine-486");

	// ---- Every scene
	for (const name of scenes) {
		await page.click(`#scenes button[data-scene=${name}]`);
		await until(async () => (await text("status")).startsWith("Playing"));
		ok(`${name} plays`, await playing() && await moves());
		ok(`${name}: the text and the link are its own`, await until(async () => page.url().includes("scene=" + name) &&
			await page.$eval("#text", (area) => area.value) ===
			fs.readFileSync(`build/web/scenes/${name}.FB`, "latin1").replaceAll("\r\n", "\n")));
	}
	await shot("scene");

	// ---- A scene of one's own
	const type = (lines) => page.$eval("#text", (area, value) => area.value = value, lines);
	await type("");
	await page.type("#text", "sphere one size 60 colour 255 0 0\nspin one axis 0 1 0 period 3\n");
	await page.click("#playText");
	const red = () => page.$eval("#canvas", (canvas) => {
		const { data } = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
		return data[0] > 60 && data[1] < 40 && data[2] < 40;
	});
	ok("a typed scene plays", await until(red));
	await shot("typed");
	const link = await page.$eval("#link", (element) => element.href);
	ok("the link holds it", /[#&]text=[\w-]+/.test(link), link);
	await type("sphere one size 60\nspere two size 20\n");
	await page.click("#playText");
	ok("a wrong one does not", await ended());
	ok("and the program says why", /^SCENE\.FB:2: 'spere': expected .*sphere/.test(await text("message")), await text("message"));
	ok("the line is selected", await page.$eval("#text",
		(area) => area.value.slice(area.selectionStart, area.selectionEnd)) === "spere two size 20");
	await shot("wrong");
	await type("sphere one size 300\n");
	await page.click("#playText");
	ok("another: the range", await until(async () => /^SCENE\.FB:1: '300': .*size from 1 to 100/.test(await text("message"))),
		await text("message"));

	// A file, dropped and chosen.
	await page.evaluate(() => {
		const data = new DataTransfer();
		data.items.add(new File(["sphere green size 60 colour 0 255 0\r\n"], "GREEN.FB"));
		document.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
	});
	const green = () => page.$eval("#canvas", (canvas) => {
		const { data } = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
		return data[1] > 60 && data[0] < 40 && data[2] < 40;
	});
	ok("a dropped file plays", await until(green) && await page.$eval("#message", (line) => line.hidden));
	fs.writeFileSync(`${SHOTS}/BLUE.FB`, "sphere blue size 60 colour 0 0 255\n");
	await (await page.$("#file")).uploadFile(`${SHOTS}/BLUE.FB`);
	ok("a chosen file plays", await until(() => page.$eval("#canvas", (canvas) => {
		const { data } = canvas.getContext("2d").getImageData(canvas.width / 2, canvas.height / 2, 1, 1);
		return data[2] > 60 && data[0] < 40 && data[1] < 40;
	})));

	// The link, in a page that knows nothing.
	const second = await browser.newPage();
	await second.goto(link);
	ok("the link brings the scene back", await second.waitForFunction(
		() => document.getElementById("text").value.startsWith("sphere one size 60 colour 255 0 0\nspin one"),
		{ timeout: SLOW }).then(() => true, () => false));
	await second.goto(home + "#scene=WALK&grey=1&machine=p75");
	ok("a link names scene, switches and machine", await second.waitForFunction(() => document.getElementById("grey").checked &&
		document.getElementById("machine-p75").checked && /walking figure/.test(document.getElementById("text").value),
	{ timeout: SLOW }).then(() => true, () => false));
	await second.goto("about:blank");
	await second.goto(home + "#plain=" + encodeURIComponent("sphere two size 44\n"));
	ok("a link may hold the text as it is", await second.waitForFunction(
		() => document.getElementById("text").value === "sphere two size 44\n", { timeout: SLOW }).then(() => true, () => false));
	await second.close();

	// ---- By hand
	// The middle of what is red, and how much there is of it.
	const redMiddle = (where) => where.$eval("#canvas", (canvas) => {
		const top = 16, { data } = canvas.getContext("2d").getImageData(0, top, 320, 200 - top);
		let x = 0, y = 0, count = 0;
		for (let i = 0; i < data.length; i += 4) {
			if (data[i] > 60 && data[i + 1] < 60) {
				x += i / 4 % 320;
				y += Math.floor(i / 4 / 320) + top;
				++count;
			}
		}
		return { x: x / count, y: y / count, count };
	});
	const twoBalls = "sphere red size 30 at -20 0 0 colour 255 0 0\nsphere blue size 30 at 30 20 0 colour 0 0 255\n";
	const near = (a, b) => Math.abs(a - b) < 2;
	await page.bringToFront();
	await page.click("#interactive");
	await type(twoBalls);
	await page.click("#playText");
	await until(async () => (await text("status")).startsWith("Playing"));
	ok("by hand: it plays", await playing());
	await wait(2000);
	const still = async () => {
		const { sum } = await picture();
		await wait(1500);
		return (await picture()).sum === sum;
	};
	ok("by hand: the model stands still", await until(still, 20000));
	await page.$eval("#screen", (element) => element.scrollIntoView());
	const box = await (await page.$("#screen")).boundingBox();
	const centre = [box.x + box.width / 2, box.y + box.height / 2];
	await page.mouse.move(...centre);
	await page.mouse.down();
	await page.mouse.up();
	ok("by hand: a click gives the mouse to the picture", await until(() => page.evaluate(
		() => document.pointerLockElement === document.getElementById("screen")), 5000));
	const start = await redMiddle(page);
	const slide = async (dx, dy) => {
		for (let i = 1; i <= 10; ++i) {
			await page.mouse.move(centre[0] + dx * i / 10, centre[1] + dy * i / 10);
			await wait(30);
		}
		await until(still, 20000);
	};
	await slide(100, 0);
	const right = await redMiddle(page);
	ok("by hand: the mouse moves the object to the right, as far as it went itself", near(right.y, start.y) &&
		Math.abs((right.x - start.x) / (100 * 320 / box.width) - 1) < 0.2, JSON.stringify([start, right]));
	await shot("hand");
	await page.mouse.down();
	await wait(300);
	await page.mouse.up();
	await until(still, 20000);
	const { sum } = await picture();
	await page.mouse.move(centre[0] + 100, centre[1] - 40);
	await until(still, 20000);
	const third = await redMiddle(page);
	ok("by hand: the left button selects the other object", near(third.x, right.x) && near(third.y, right.y) &&
		(await picture()).sum !== sum, JSON.stringify([right, third]));
	await page.evaluate(() => document.exitPointerLock());

	// Keys: from the keyboard while the picture has the focus, and from the buttons.
	await page.click("#interactive");
	await page.click("#scenes button[data-scene=FOUR]");
	await until(async () => (await text("status")).startsWith("Playing"));
	await playing();
	await wait(1000);
	await page.click("#keys button[data-key='-']");
	await wait(500);
	await page.click("#keys button[data-key='-']");
	await wait(1000);
	await page.focus("#screen");
	await page.keyboard.press("-");
	await wait(1000);
	await page.keyboard.press("Escape");
	ok("Escape ends", await ended());
	ok("three keys made the sampling coarser", Number((await statistics()).seeds) < 2496 / 2, (await statistics()).seeds);

	// ---- On a phone
	const phone = await browser.newPage();
	await phone.setViewport({ width: 360, height: 740, isMobile: true, hasTouch: true, deviceScaleFactor: 2 });
	phone.on("pageerror", (error) => errors.push("phone: " + error.message));
	await phone.goto(home, { waitUntil: "load" });
	ok("a phone: nothing is wider than the screen", await phone.evaluate(() => document.documentElement.scrollWidth <= 360),
		await phone.evaluate(() => document.documentElement.scrollWidth));
	ok("a phone: buttons are as large as a finger", await phone.evaluate(
		() => [...document.querySelectorAll("button")].every((button) => button.hidden || button.getBoundingClientRect().height >= 40)));
	await phone.tap("#interactive");
	await phone.$eval("#text", (area, value) => area.value = value, twoBalls);
	await phone.tap("#playText");
	const phonePlays = await phone.waitForFunction(() => document.getElementById("canvas").width === 320 &&
		document.getElementById("canvas").height === 200, { timeout: SLOW }).then(() => true, () => false);
	ok("a phone: a tap plays", phonePlays);
	await wait(2500);
	const [x, y] = await phone.$eval("#screen", (element) => {
		element.scrollIntoView();
		const r = element.getBoundingClientRect();
		return [r.x + r.width / 2, r.y + r.height / 2];
	});
	const untouched = await redMiddle(phone);
	await phone.touchscreen.touchStart(x, y);
	for (let i = 1; i <= 10; ++i) {
		await phone.touchscreen.touchMove(x + 5 * i, y);
		await wait(30);
	}
	await phone.touchscreen.touchEnd();
	await wait(1500);
	const touched = await redMiddle(phone);
	ok("a phone: a finger moves the object to the right", touched.x - untouched.x > 20 && near(touched.y, untouched.y),
		JSON.stringify([untouched, touched]));
	await phone.screenshot({ path: `${SHOTS}/phone.png`, fullPage: true });
	await phone.close();

	ok("no error in the console", errors.length === 0, errors.join(" | "));
	ok("nothing was asked of the network", outside.length === 0, outside.join(" "));
	console.log("# screenshots: " + SHOTS);
}

main().catch((error) => ok("the test itself", false, error.stack)).finally(() => {
	console.log(`${passed} passed, ${failed} failed`);
	process.exitCode = failed === 0 ? 0 : 1;
});
