// The page that plays DEMO.EXE: scenes, switches and machines on one side, an emulated PC on the other. The PC is started
// anew for each run and ended when the program ends; what the program printed is read from the file that RUN.COM left.
"use strict";

// Instructions a millisecond as in tools/bench.sh; the figures are the report's, which has none for a 386.
const MACHINES = [
	{ id: "386", name: "386DX-40", cycles: 8000, report: null },
	{ id: "486", name: "486DX2-66", cycles: 25000, report: 1.15 },
	{ id: "p75", name: "Pentium 75", cycles: 42000, report: 2.95 },
	{ id: "p166", name: "Pentium 166", cycles: 100000, report: 6.63 },
	{ id: "p266", name: "Pentium II 266", cycles: 177000, report: 13.09 },
];
const MEASURED = 10;  // seconds of the PC's clock
const WIDTH = 320, HEIGHT = 200;
const KEYS = { Escape: 256, Enter: 257, Tab: 258, Backspace: 259, Insert: 260, Delete: 261, ArrowRight: 262, ArrowLeft: 263,
	ArrowDown: 264, ArrowUp: 265, PageUp: 266, PageDown: 267, F1: 290, F2: 291, F3: 292, Space: 32, Comma: 44, Minus: 45,
	Period: 46, Equal: 61, BracketLeft: 91, BracketRight: 93, ShiftLeft: 340, ShiftRight: 344, NumpadMultiply: 332,
	NumpadSubtract: 333, NumpadAdd: 334 };
// What a key button of the page presses.
const BUTTONS = { f: 70, "*": 332, "-": 333, "+": 334, F1: 290, Tab: 258 };

const $ = (id) => document.getElementById(id);
const canvas = $("canvas"), screen = $("screen"), context = canvas.getContext("2d");

const state = { scene: "FOUR", text: null, machine: MACHINES[1] };
const switches = ["grey", "printed", "interactive"];
const texts = {};  // of the shipped scenes
let pc = null;     // what plays now: { ci, run }
let runs = 0;      // a run that is not the last one has nothing more to say
let exe = null;    // DEMO.EXE and RUN.COM, fetched once

function say(text) {
	$("status").textContent = text;
}

async function fetchBytes(name) {
	const response = await fetch(name);
	if (!response.ok)
		throw new Error(name + ": " + response.status);
	return new Uint8Array(await response.arrayBuffer());
}

async function sceneText(name) {
	if (texts[name] === undefined)
		texts[name] = new TextDecoder("latin1").decode(await fetchBytes("scenes/" + name + ".FB"));
	return texts[name];
}

// The bytes of a text as DOS has them.
function bytesOf(text) {
	return Uint8Array.from(text, (c) => c.charCodeAt(0) < 256 ? c.charCodeAt(0) : 63);
}

// ---- The link: the scene by name or, when it was typed, packed into the address

async function pack(text, stream) {
	const piped = new Blob([text]).stream().pipeThrough(stream);
	return new Uint8Array(await new Response(piped).arrayBuffer());
}

async function updateLink() {
	const fields = new URLSearchParams();
	if (state.text === null) {
		fields.set("scene", state.scene);
	} else if (typeof CompressionStream === "undefined") {
		fields.set("plain", state.text);
	} else {
		const bytes = await pack(state.text, new CompressionStream("deflate-raw"));
		let binary = "";
		for (const byte of bytes)
			binary += String.fromCharCode(byte);
		fields.set("text", btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", ""));
	}
	for (const name of switches) {
		if ($(name).checked)
			fields.set(name, "1");
	}
	fields.set("machine", state.machine.id);
	$("link").href = "#" + fields;
	history.replaceState(null, "", "#" + fields);
}

async function readLink() {
	const fields = new URLSearchParams(location.hash.slice(1));
	for (const name of switches)
		$(name).checked = fields.get(name) === "1";
	state.machine = MACHINES.find((m) => m.id === fields.get("machine")) ?? state.machine;
	$("machine-" + state.machine.id).checked = true;
	const packed = fields.get("text");
	const names = sceneButtons().map((button) => button.dataset.scene);
	state.text = fields.get("plain");
	if (names.includes(fields.get("scene")))
		state.scene = fields.get("scene");
	if (packed !== null) {
		try {
			const binary = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
			const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
			state.text = new TextDecoder().decode(await pack(bytes, new DecompressionStream("deflate-raw")));
		} catch (error) {
			complain("The link does not hold a whole scene.");
		}
	}
	$("text").value = state.text ?? await sceneText(state.scene);
	showChoice();
}

// ---- What is chosen

function sceneButtons() {
	return [...document.querySelectorAll("#scenes button")];
}

function showChoice() {
	for (const button of sceneButtons())
		button.setAttribute("aria-pressed", String(state.text === null && button.dataset.scene === state.scene));
	screen.classList.toggle("hand", $("interactive").checked);
	if (pc === null && state.text === null)
		showPoster();
}

function showPoster() {
	const picture = sceneButtons().find((button) => button.dataset.scene === state.scene).querySelector("img");
	const draw = () => {
		if (pc === null) {
			canvas.width = picture.naturalWidth;
			canvas.height = picture.naturalHeight;
			context.drawImage(picture, 0, 0);
		}
	};
	picture.complete ? draw() : picture.addEventListener("load", draw, { once: true });
}

async function chooseScene(name) {
	state.scene = name;
	state.text = null;
	$("text").value = await sceneText(name);
	await play();
}

async function chooseText() {
	state.text = $("text").value;
	await play();
}

// ---- The program's words

function complain(line) {
	$("message").textContent = line;
	$("message").hidden = line === "";
	const at = /^[^:]*:([0-9]+): /.exec(line);
	if (at === null)
		return;
	// The line that is meant, selected.
	const lines = $("text").value.split("\n");
	const from = lines.slice(0, at[1] - 1).join("\n").length + (at[1] > 1 ? 1 : 0);
	$("text").setSelectionRange(from, from + (lines[at[1] - 1] ?? "").length);
}

// The statistics among the lines that the program printed, and whatever else it said.
function understand(output) {
	const values = {}, rest = [];
	for (const line of output.split(/\r?\n/)) {
		const pair = /^([a-z][a-z -]*): ([0-9.]+)$/.exec(line);
		if (pair !== null)
			values[pair[1]] = pair[2];
		else if (line.trim() !== "")
			rest.push(line.trim());
	}
	return { values, rest };
}

// What a run was of: its scene and switches, for the table.
function runName(run) {
	return run.name + run.switches.map((s) => " " + s).join("");
}

function showStatistics(run, output) {
	const { values, rest } = understand(output);
	if (values.fps === undefined) {
		if (rest.length > 0)
			complain(rest.join(" "));
		return false;
	}
	$("stats").textContent = output.trim();
	// The report's figures are of its own scene.
	const comparable = run.name === "FOUR" && !run.switches.includes("/I");
	const report = comparable && run.machine.report !== null ? run.machine.report.toFixed(2) : "\u2013";
	const figure = $("figure"), bold = document.createElement("b");
	bold.textContent = Number(values.fps).toFixed(1);
	figure.replaceChildren(bold, ` frames a second on a ${run.machine.name}` +
		(run.machine.report === null ? "; the report has no figure for it." :
			`; the report measured ${run.machine.report.toFixed(2)} with its four spheres.`));
	const name = runName(run), body = $("runs").tBodies[0];
	let row = [...body.rows].find((r) => r.cells[0].textContent === name && r.cells[1].textContent === run.machine.name);
	if (row === undefined) {
		row = body.insertRow(0);
		for (let i = 0; i < 4; ++i)
			row.insertCell();
	}
	[name, run.machine.name, Number(values.fps).toFixed(1), report].forEach((text, i) => row.cells[i].textContent = text);
	$("runs").hidden = false;
	return true;
}

// ---- The PC

function configuration(run) {
	const command = "RUN /M:SCENE.FB " + run.switches.join(" ");
	// By hand nothing is measured first, for what was done would be lost.
	const first = run.switches.includes("/I") ? [] :
		[`${command} /T:${MEASURED} > FIRST.TXT`, "if errorlevel 1 goto end", "echo fb-first"];
	return ["[sdl]", "autolock=false", "[dosbox]", "memsize=16", "machine=svga_s3", "[cpu]", "core=normal", "cputype=auto",
		"cycles=fixed " + run.machine.cycles, "[mixer]", "nosound=true", "[sblaster]", "sbtype=none", "oplmode=none",
		"[speaker]", "pcspeaker=false", "[autoexec]", "@echo off", "mount c . > nul", "c:", "cls", ...first,
		`${command} > SECOND.TXT`, ":end", "echo fb-end", ""].join("\n");
}

async function fileText(ci, name) {
	return new TextDecoder("latin1").decode(await ci.fsReadFile(name));
}

async function play() {
	complain("");
	await end();
	const number = ++runs;
	const run = {
		name: state.text === null ? state.scene : "your scene",
		text: state.text ?? await sceneText(state.scene),
		machine: state.machine,
		switches: [...switches.filter((name) => $(name).checked).map((name) => $(name).dataset.switch)],
		// ESC ends a part of the run; after this nothing more is played.
		stopped: false,
	};
	showChoice();
	await updateLink();
	$("play").hidden = true;
	say("Loading the PC ...");
	try {
		exe ??= await Promise.all([fetchBytes("DEMO.EXE"), fetchBytes("RUN.COM")]);
		// The emulator takes the bytes away, so each run has its own.
		const file = (path, bytes) => ({ path, contents: bytes.slice() });
		const ci = await emulators.dosboxWorker([{ dosboxConf: configuration(run), jsdosConf: { version: "8" } },
			file("DEMO.EXE", exe[0]), file("RUN.COM", exe[1]), file("SCENE.FB", bytesOf(run.text))]);
		if (number !== runs) {
			ci.exit();
			return;
		}
		pc = { ci, run };
		// Until it is moved by steps, the emulated mouse jumps to a place of the emulator's own.
		ci.sendMouseRelativeMotion(0, 0);
		$("stop").disabled = false;
		say(`Playing on a ${run.machine.name} ...`);
		listen(ci, run, number);
	} catch (error) {
		if (number === runs) {
			say("The PC could not be started: " + error.message);
			$("play").hidden = false;
		}
	}
}

function listen(ci, run, number) {
	// While the PC changes between text and graphics there is rubbish on its screen for a moment, and the emulator tells of
	// the new mode only then. Frames are shown a little later, and what came last before a change is not shown at all.
	// By hand nobody wants to wait; there the mode changes only at the end.
	const hold = run.switches.includes("/I") ? 0 : 150;
	let frames = [], graphics = false;
	const draw = () => {
		if (number !== runs)
			return;
		const due = frames.filter((frame) => frame.at <= performance.now() - hold);
		if (due.length > 0) {
			[canvas.width, canvas.height] = [WIDTH, HEIGHT];
			context.putImageData(due.at(-1).image, 0, 0);
			frames = frames.slice(due.length);
		}
		if (frames.length > 0)
			requestAnimationFrame(draw);
	};
	ci.events().onFrameSize((width, height) => {
		graphics = width === WIDTH && height === HEIGHT;
		frames = [];
	});
	// Only the program's own picture is shown, not DOS's text before and after it.
	ci.events().onFrame((rgb) => {
		if (!graphics || number !== runs)
			return;
		const image = context.createImageData(WIDTH, HEIGHT), { data } = image;
		for (let from = 0, to = 0; to < data.length; from += 3, to += 4) {
			data[to] = rgb[from];
			data[to + 1] = rgb[from + 1];
			data[to + 2] = rgb[from + 2];
			data[to + 3] = 255;
		}
		frames.push({ image, at: performance.now() });
		if (frames.length === 1)
			requestAnimationFrame(draw);
	});
	const begun = performance.now();
	let words = "";
	ci.events().onStdout(async (text) => {
		words += text;
		if (number !== runs)
			return;
		if (words.includes("fb-first")) {
			words = "";
			const output = await fileText(ci, "FIRST.TXT");
			if (number === runs && showStatistics(run, output)) {
				const share = understand(output).values.seconds * 1000 / (performance.now() - begun);
				say(`Playing on a ${run.machine.name}` + (share < 0.8 ? `, at ${Math.round(share * 100)}% of its pace ...` : " ..."));
			}
			if (run.stopped)
				finish(ci, number);
		} else if (words.includes("fb-end")) {
			words = "";
			for (const name of run.switches.includes("/I") ? ["SECOND.TXT"] : ["FIRST.TXT", "SECOND.TXT"]) {
				const tree = await ci.fsTree();
				if (JSON.stringify(tree).includes(name))
					showStatistics(run, await fileText(ci, name));
			}
			finish(ci, number);
		}
	});
}

// The program has ended by itself, by ESC or with a message.
function finish(ci, number) {
	if (number !== runs)
		return;
	++runs;
	pc = null;
	ci.exit();
	$("stop").disabled = true;
	$("play").hidden = false;
	say($("message").hidden ? "Ended." : "The program did not play; what it said stands under the text.");
}

// Ends what plays, whatever it has to say.
async function end() {
	++runs;
	if (pc === null)
		return;
	const { ci } = pc;
	pc = null;
	$("stop").disabled = true;
	await ci.exit();
}

function press(code) {
	if (pc !== null)
		pc.ci.simulateKeyPress(code);
}

// ---- Hands: keyboard, mouse, fingers

function keyCode(event) {
	const letter = /^(?:Key|Digit)(.)$/.exec(event.code);
	return letter !== null ? letter[1].charCodeAt(0) : KEYS[event.code];
}

function listenToHands() {
	const send = (event, pressed) => {
		const code = keyCode(event);
		if (pc === null || code === undefined || event.ctrlKey || event.altKey || event.metaKey)
			return;
		event.preventDefault();
		if (code === KEYS.Escape && pressed)
			pc.run.stopped = true;
		pc.ci.sendKeyEvent(code, pressed);
	};
	screen.addEventListener("keydown", (event) => send(event, true));
	screen.addEventListener("keyup", (event) => send(event, false));

	const byHand = () => pc !== null && pc.run.switches.includes("/I");
	// The program's mouse counts whole steps, of which some two move an object by a pixel of its picture.
	let restX = 0, restY = 0;
	const move = (dx, dy) => {
		const scale = 2 * WIDTH / screen.clientWidth;
		restX += dx * scale;
		restY += dy * scale;
		const x = Math.trunc(restX), y = Math.trunc(restY);
		restX -= x;
		restY -= y;
		if (x !== 0 || y !== 0)
			pc.ci.sendMouseRelativeMotion(x, y);
	};
	const fingers = new Map();
	let travelled = 0;
	screen.addEventListener("contextmenu", (event) => event.preventDefault());
	screen.addEventListener("pointerdown", (event) => {
		if (!byHand() || event.target === $("play"))
			return;
		screen.focus();
		event.preventDefault();
		if (event.pointerType === "mouse") {
			// The first click only gives the mouse to the picture.
			if (document.pointerLockElement !== screen && screen.requestPointerLock !== undefined)
				Promise.resolve(screen.requestPointerLock()).catch(() => {});
			else
				pc.ci.sendMouseButton(event.button === 2 ? 1 : 0, true);
			return;
		}
		screen.setPointerCapture(event.pointerId);
		fingers.set(event.pointerId, [event.clientX, event.clientY]);
		travelled = fingers.size === 1 ? 0 : travelled;
		if (fingers.size === 2)
			pc.ci.sendMouseButton(1, true);
	});
	screen.addEventListener("pointermove", (event) => {
		if (!byHand())
			return;
		if (event.pointerType === "mouse") {
			if (document.pointerLockElement === screen)
				move(event.movementX, event.movementY);
			return;
		}
		const before = fingers.get(event.pointerId);
		if (before === undefined)
			return;
		const dx = event.clientX - before[0], dy = event.clientY - before[1];
		fingers.set(event.pointerId, [event.clientX, event.clientY]);
		travelled += Math.abs(dx) + Math.abs(dy);
		move(dx / fingers.size, dy / fingers.size);
	});
	const up = (event) => {
		if (!byHand())
			return;
		if (event.pointerType === "mouse") {
			pc.ci.sendMouseButton(event.button === 2 ? 1 : 0, false);
			return;
		}
		if (!fingers.delete(event.pointerId))
			return;
		if (fingers.size === 1)
			pc.ci.sendMouseButton(1, false);
		if (fingers.size === 0 && travelled < 10) {
			const { ci } = pc;
			ci.sendMouseButton(0, true);
			setTimeout(() => ci.sendMouseButton(0, false), 100);
		}
	};
	screen.addEventListener("pointerup", up);
	screen.addEventListener("pointercancel", up);
}

// ---- The page

async function open(file) {
	const text = new TextDecoder("latin1").decode(await file.arrayBuffer());
	$("text").value = text.replaceAll("\r\n", "\n");
	await chooseText();
}

async function start() {
	emulators.pathPrefix = "emulators/";
	const switchNames = { grey: "/G", printed: "/P", interactive: "/I" };
	for (const name of switches) {
		$(name).dataset.switch = switchNames[name];
		$(name).addEventListener("change", async () => {
			showChoice();
			await (pc !== null ? play() : updateLink());
		});
	}
	for (const machine of MACHINES) {
		const label = document.createElement("label"), input = document.createElement("input");
		const small = document.createElement("small");
		Object.assign(input, { type: "radio", name: "machine", id: "machine-" + machine.id });
		small.textContent = machine.report === null ? "not in the report" : `the report: ${machine.report.toFixed(2)} frames/s`;
		label.append(input, " " + machine.name, small);
		$("machines").append(label);
		input.addEventListener("change", () => {
			state.machine = machine;
			play();
		});
	}
	for (const button of sceneButtons())
		button.addEventListener("click", () => chooseScene(button.dataset.scene));
	for (const button of document.querySelectorAll("#keys button"))
		button.addEventListener("click", () => press(BUTTONS[button.dataset.key]));
	$("play").addEventListener("click", () => {
		screen.focus();
		play();
	});
	$("stop").addEventListener("click", () => {
		if (pc !== null)
			pc.run.stopped = true;
		press(KEYS.Escape);
	});
	$("playText").addEventListener("click", chooseText);
	$("copy").addEventListener("click", async () => {
		state.text = $("text").value === await sceneText(state.scene) ? null : $("text").value;
		await updateLink();
		try {
			await navigator.clipboard.writeText($("link").href);
			$("copy").textContent = "Copied";
		} catch (error) {
			$("copy").textContent = "The link is at the right";
		}
		setTimeout(() => $("copy").textContent = "Copy a link to it", 3000);
	});
	$("file").addEventListener("change", () => {
		if ($("file").files.length > 0)
			open($("file").files[0]);
		$("file").value = "";
	});
	for (const kind of ["dragenter", "dragover"]) {
		document.addEventListener(kind, (event) => {
			event.preventDefault();
			$("text").classList.add("over");
		});
	}
	document.addEventListener("dragleave", () => $("text").classList.remove("over"));
	document.addEventListener("drop", (event) => {
		event.preventDefault();
		$("text").classList.remove("over");
		if (event.dataTransfer.files.length > 0)
			open(event.dataTransfer.files[0]);
	});
	listenToHands();
	window.addEventListener("hashchange", async () => {
		await end();
		await readLink();
		await play();
	});
	await readLink();
}

start().catch((error) => say("The page could not be started: " + error.message));
