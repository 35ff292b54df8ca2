const data = JSON.parse(document.getElementById("data").textContent);
const $ = id => document.getElementById(id);
const { scene, loops, clouds } = data;
const vectors = array => Array.from({ length: array.length / 3 }, (_, k) => new THREE.Vector3(...array.subarray(3 * k, 3 * k + 3)));

// ---- Charts

const charts = $("charts");
Plotly.newPlot(charts, data.charts.data, data.charts.layout, { responsive: true, displaylogo: false,
  modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d"], toImageButtonOptions: { format: "svg" } })
  .then(() => { document.body.dataset.ready = "true"; });
charts.on("plotly_hover", ({ points: [point] }) => {
  const next = times.findIndex(time => time >= point.x), at = next < 0 ? times.length - 1 : next;
  here.geometry.attributes.position.array.set(best.subarray(3 * at, 3 * at + 3));
  here.geometry.attributes.position.needsUpdate = true;
  here.visible = true;
  view.draw();
});
charts.on("plotly_unhover", () => { here.visible = false; view.draw(); });

// ---- Map and trajectories

let view;
try {
  view = new View($("map"));
} catch (error) {
  $("map").textContent = "This browser draws nothing in 3-D: WebGL is off.";
  throw error; // the charts are there
}
const cloud = scene.map && mapCloud(scene.map);
if (cloud) view.scenes[0].add(cloud);
const times = decode(scene.time);
const paths = Object.fromEntries(Object.entries(scene.paths).map(([name, path]) => [name, decode(path)]));
const best = paths.final;
const spots = vectors(best);

const accepted = loops.filter(loop => loop.accepted), refused = loops.filter(loop => !loop.accepted);
const layers = {
  live: paths.live?.length > 3 && [view.addLine(paths.live, COLOUR.live, 2)],
  final: paths.final.length > 3 && [view.addLine(paths.final, COLOUR.final, 3)],
  accepted: accepted.length && [view.addLine(accepted.flatMap(loop => loop.place.flat()), COLOUR.accepted, 2, true),
    view.addDots(accepted.flatMap(loop => loop.place[1]), COLOUR.accepted, 11)],
  refused: refused.length && [view.addLine(refused.flatMap(loop => loop.place.flat()), COLOUR.refused, 1, true)],
};
const here = view.addDots([0, 0, 0], COLOUR.here, 16);
const chosen = view.addDots([0, 0, 0, 0, 0, 0], COLOUR.match, 18);
here.visible = chosen.visible = false;

const NAMES = { live: "trajectory before loops", final: paths.live ? "trajectory after loops" : "trajectory", accepted: "loops", refused: "refused candidates" };
for (const [name, objects] of Object.entries(layers)) {
  if (!objects) continue;
  const shown = name !== "refused";
  const label = document.createElement("label");
  label.innerHTML = `<input type="checkbox" ${shown ? "checked" : ""}><i style="background:${COLOUR[name]}"></i>${NAMES[name]}`;
  const show = on => { for (const object of objects) object.visible = on; view.draw(); };
  label.firstChild.onchange = event => show(event.target.checked);
  show(shown);
  $("legend").append(label);
}

const box = new THREE.Box3().setFromPoints(spots);
const middle = box.getCenter(new THREE.Vector3());
const radius = 0.45 * box.getSize(new THREE.Vector3()).length() + 10; // with what stands beside the path
$("top").onclick = () => view.look(middle, radius, new THREE.Vector3(0, -0.001, 1));
$("side").onclick = () => view.look(middle, radius, new THREE.Vector3(-0.45, -0.8, 0.85));
$("picture").onclick = () => {
  const link = document.createElement("a");
  link.download = `${document.title}.png`;
  link.href = view.renderer.domElement.toDataURL();
  link.click();
};

// The length of a round number of metres at the middle of the picture.
view.onrender = () => {
  const distance = view.camera.position.distanceTo(view.controls.target);
  const metresPerPixel = 2 * distance * Math.tan(THREE.MathUtils.degToRad(view.camera.fov / 2)) / view.size.y;
  const most = 160 * metresPerPixel, power = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].find(k => k * power <= most) * power;
  $("ruler").style.width = `${metres / metresPerPixel}px`;
  $("ruler").firstChild.textContent = `${+metres.toPrecision(1)} m`;
};

if (cloud) {
  const { uniforms } = cloud.material, { map } = scene;
  const SCALES = [[map.height, "m"], [map.aboveRange, "m"], [map.intensityRange, ""], [map.timeRange, "s"]];
  const update = () => {
    uniforms.mode.value = +$("colour").value;
    uniforms.size.value = +$("size").value * window.devicePixelRatio;
    uniforms.limit.value = $("cut").checked ? 100 * $("limit").value : 1e6;
    const [range, unit] = SCALES[uniforms.mode.value];
    const digits = range[1] - range[0] < 10 ? 1 : 0;
    $("low").textContent = range[0].toFixed(digits);
    $("high").textContent = `${range[1].toFixed(digits)} ${unit}`;
    view.draw();
  };
  uniforms.height.value.set(...map.height.map(z => z - scene.centre[2]));
  $("cut").checked = map.roofed;
  for (const id of ["colour", "size", "cut", "limit"]) $(id).oninput = update;
  const bar = $("bar").getContext("2d");
  for (let x = 0; x < 160; ++x) { bar.fillStyle = `rgb(${shade(x / 159)})`; bar.fillRect(x, 0, 1, 10); }
  const spaced = count => count.toLocaleString("en").replaceAll(",", "\u202f");
  $("shown").textContent = map.count < map.total ? `${spaced(map.count)} of the map's ${spaced(map.total)} points are shown.`
    : `The map has ${spaced(map.total)} points, all of them shown.`;
  update();
} else {
  $("controls").hidden = true;
}
$("side").click();

// ---- Loops

const COLUMNS = [
  ["query", loop => loop.query], ["match", loop => loop.match],
  ["time (s)", loop => loop.time[1].toFixed(1)], ["first visit (s)", loop => loop.time[0].toFixed(1)],
  ["detector", loop => loop.detector === "radius" ? "radius" : "Scan Context"],
  ["distance", loop => (+loop.distance).toFixed(3) + (loop.detector === "radius" ? " m" : "")],
  ["yaw (°)", loop => loop.detector === "radius" ? "" : (+loop.yaw_deg).toFixed(1)],
  ["overlap", loop => verified(loop) ? loop.overlap : "–"], ["ICP RMSE (m)", loop => verified(loop) ? (+loop.rmse_m).toFixed(3) : "–"],
];
const verified = loop => +loop.overlap > 0; // else ICP was not asked
const DRIFT = [["drift found (m)", loop => loop.drift_m.toFixed(2)], ["(°)", loop => loop.drift_deg.toFixed(2)]];
const REASON = [["refused because", loop => REASONS[loop.verdict] ?? loop.verdict, "word"]];
const REASONS = {
  no_match: "too few points of the query meet the local map",
  low_overlap: "too little overlap",
  high_rmse: "ICP residual too large",
  implausible: "height, roll or pitch differ too much",
  degenerate: "the place does not fix the pose",
  inconsistent: "contradicts the pose graph beyond drift",
  contradicted: "the optimised graph does not bear it",
};

function table(list, columns) {
  const element = document.createElement("div");
  element.className = "rows";
  const head = columns.map(([name, , kind]) => `<th class="${kind ?? ""}">${name}</th>`).join("");
  element.innerHTML = `<table class="numbers"><thead><tr>${head}</tr></thead><tbody></tbody></table>`;
  for (const loop of list) {
    const row = element.querySelector("tbody").insertRow();
    row.dataset.loop = loops.indexOf(loop);
    for (const [, text, kind] of columns) {
      const cell = row.insertCell();
      cell.textContent = text(loop);
      if (kind) cell.className = kind;
    }
    row.onclick = () => select(loop);
  }
  return element;
}

if (accepted.length) $("loops").append(table(accepted, [...COLUMNS, ...DRIFT]));
else $("loops").innerHTML = `<p>No loop was accepted${loops.length ? "" : ", and none was looked at"}.</p>`;
if (refused.length) {
  const counts = Object.entries(refused.reduce((sum, { verdict }) => ({ ...sum, [verdict]: (sum[verdict] ?? 0) + 1 }), {}));
  counts.sort((a, b) => b[1] - a[1]);
  const reasons = counts.map(([verdict, count]) => `${count}: ${REASONS[verdict] ?? verdict}`).join("; ");
  $("refused").innerHTML = `<h3>Refused candidates</h3><p class="note">${reasons}.</p><details><summary>all ${refused.length}</summary></details>`;
  $("refused").querySelector("details").append(table(refused, [...COLUMNS, ...REASON]));
}

// The two scans of a loop, before and after ICP, in the frame of the earlier one.
let pair;
function showPair(loop) {
  const scans = [loop.match, loop.query].map(number => clouds.points?.[number]);
  $("pair").hidden = !scans.every(Boolean);
  if ($("pair").hidden) return;
  if (!pair) {
    pair = new View($("pair").querySelector(".view"));
    pair.scenes.push(new THREE.Scene());
    pair.camera.aspect /= 2;
  }
  const [match, query] = scans.map(decode);
  pair.scenes.forEach((side, k) => {
    for (const object of [...side.children]) { object.geometry.dispose(); side.remove(object); }
    const moved = scanCloud(query, clouds.step, COLOUR.query);
    moved.matrix.fromArray(k === 0 ? loop.before : loop.after).multiply(moved.unit);
    side.add(scanCloud(match, clouds.step, COLOUR.match), moved);
  });
  const ranges = Float32Array.from({ length: match.length / 3 }, (_, i) => Math.hypot(match[3 * i], match[3 * i + 1])).sort();
  const reach = Math.min(Math.max(clouds.step * ranges[Math.floor(0.8 * ranges.length)], 8), 60);
  $("pairFacts").textContent = `Key frame ${loop.query} at ${loop.time[1].toFixed(1)} s closes a loop with key frame ` +
    `${loop.match} at ${loop.time[0].toFixed(1)} s: ${COLUMNS[4][1](loop)} distance ${COLUMNS[5][1](loop)}, overlap ` +
    `${loop.overlap}, ICP RMSE ${(+loop.rmse_m).toFixed(3)} m; the odometry had drifted by ${loop.drift_m.toFixed(2)} m and ` +
    `${loop.drift_deg.toFixed(2)}° since.`;
  $("guess").textContent = loop.detector === "radius" ? "Before ICP: as the odometry has them."
    : "Before ICP: one on the other, turned as Scan Context says.";
  pair.look(new THREE.Vector3(), reach, new THREE.Vector3(-0.001, 0, 1));
}

function select(loop) {
  for (const row of document.querySelectorAll("tr[data-loop]"))
    row.classList.toggle("selected", +row.dataset.loop === loops.indexOf(loop));
  document.querySelector("tr.selected").scrollIntoView({ block: "nearest" });
  chosen.geometry.attributes.position.array.set(loop.place.flat());
  chosen.geometry.attributes.position.needsUpdate = true;
  chosen.visible = true;
  view.draw();
  showPair(loop);
}

// A click on the map that is no drag selects the loop under it.
let pressed;
const mapCanvas = view.renderer.domElement;
mapCanvas.addEventListener("pointerdown", event => { pressed = [event.clientX, event.clientY]; });
mapCanvas.addEventListener("pointerup", event => {
  if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > 4) return;
  const frame = mapCanvas.getBoundingClientRect();
  const distanceTo = loop => {
    const spot = new THREE.Vector3(...loop.place[1]).project(view.camera);
    return Math.hypot((spot.x + 1) / 2 * frame.width - (event.clientX - frame.x), (1 - spot.y) / 2 * frame.height - (event.clientY - frame.y));
  };
  const nearest = accepted.map(loop => [distanceTo(loop), loop]).sort((a, b) => a[0] - b[0])[0];
  if (nearest?.[0] < 12) select(nearest[1]);
});
if (accepted.length) select(accepted[0]);
window.scrollTo(0, 0);
