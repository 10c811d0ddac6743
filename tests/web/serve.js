// A server of static files, for looking at the page and for its tests: node tests/web/serve.js FOLDER [PORT]
"use strict";
const fs = require("fs");
const http = require("http");
const path = require("path");

const TYPES = { ".html": "text/html; charset=utf-8", ".js": "text/javascript; charset=utf-8", ".css": "text/css; charset=utf-8",
	".wasm": "application/wasm", ".png": "image/png", ".FB": "text/plain; charset=us-ascii" };

// Resolves to the server, listening on this machine alone; port 0 takes a free one.
function serve(folder, port) {
	const root = path.resolve(folder);
	const server = http.createServer((request, response) => {
		let name = decodeURIComponent(request.url.split("?")[0]);
		if (name.endsWith("/"))
			name += "index.html";
		const file = path.join(root, name);
		if (!file.startsWith(root + path.sep) || !fs.existsSync(file) || !fs.statSync(file).isFile()) {
			response.writeHead(404).end();
			return;
		}
		response.writeHead(200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" });
		fs.createReadStream(file).pipe(response);
	});
	return new Promise((resolve, reject) => {
		server.on("error", reject);
		server.listen(port, "127.0.0.1", () => resolve(server));
	});
}

module.exports = { serve };

if (require.main === module) {
	serve(process.argv[2] ?? "build/web", Number(process.argv[3] ?? 8000)).then((server) => {
		console.log(`http://localhost:${server.address().port}/`);
	});
}
