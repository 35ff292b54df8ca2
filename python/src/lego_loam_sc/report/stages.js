"use strict";
const stages = JSON.parse(document.getElementById("data").textContent);
const { rows, columns } = stages;
const height = Math.max(2, Math.min(12, Math.round(200 / rows))); // screen pixels of a row

const mix = (a, b, t) => a.map((v, k) => v + t * (b[k] - v));
const VIRIDIS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
function viridis(t) {
  const at = Math.min(Math.max(t, 0), 0.9999) * (VIRIDIS.length - 1);
  return mix(VIRIDIS[Math.floor(at)], VIRIDIS[Math.floor(at) + 1], at % 1);
}
const PALETTE = [[31, 119, 180], [44, 160, 44], [148, 103, 189], [140, 86, 75], [23, 190, 207], [188, 189, 34],
  [90, 90, 90], [230, 168, 0]];
const FEATURES = ["none", "planar, large set", "planar, flat", "edge, large set", "edge, sharp"];
const FEATURE_COLOURS = [[205, 205, 205], [255, 140, 0], [255, 20, 147], [0, 64, 255], [0, 130, 0]];

// The value below which this share of the list lies.
function quantile(list, share) {
  const sorted = list.filter(v => v !== null).sort((a, b) => a - b);
  return sorted.length ? sorted[Math.floor(share * (sorted.length - 1))] : 0;
}
const near = quantile(stages.range, 0.01), far = Math.max(quantile(stages.range, 0.99), near + 1);
const dim = quantile(stages.intensity, 0.02), bright = Math.max(quantile(stages.intensity, 0.98), dim + 1);

const key = pairs => pairs.map(([colour, name]) => `<i style="background:rgb(${colour})"></i>${name}`).join("");
const LAYERS = [
  ["Range", `${(near / 1000).toFixed(1)} m dark to ${(far / 1000).toFixed(1)} m light, logarithmic`,
    i => viridis(Math.log(stages.range[i] / near) / Math.log(far / near))],
  ["Intensity", `${dim / 1000} dark to ${bright / 1000} light`,
    i => viridis((stages.intensity[i] - dim) / (bright - dim))],
  ["Ground and clusters", key([[[224, 32, 32], "ground"], [[205, 205, 205], "in no cluster"]]) +
    " &nbsp;others: one colour for each cluster",
    i => stages.ground[i] ? [224, 32, 32] : stages.cluster[i] < 0 ? [205, 205, 205] : PALETTE[stages.cluster[i] % 8]],
  ["Roughness", key([[[0, 70, 220], "a hundredth of the threshold c_th, or less"], [[230, 230, 230], "at c_th"],
    [[220, 20, 0], "a hundred times c_th"]]),
    i => {
      if (stages.sharpness[i] === null) return [255, 255, 255];
      const t = Math.min(Math.max(Math.log10(Math.max(stages.sharpness[i], 1) / 1000) / 2, -1), 1);
      return mix([230, 230, 230], t < 0 ? [0, 70, 220] : [220, 20, 0], Math.abs(t));
    }],
  ["Features", key([1, 2, 3, 4].map(k => [FEATURE_COLOURS[k], FEATURES[k]])), i => FEATURE_COLOURS[stages.feature[i]]],
];

// Column 0 is straight back and columns go counter-clockwise, so to the left.
const indexAt = (x, y) => (rows - 1 - y) * columns + (columns - 1 - x);

function draw(canvas, colourOf) {
  const context = canvas.getContext("2d");
  const image = context.createImageData(columns, rows);
  for (let y = 0; y < rows; ++y)
    for (let x = 0; x < columns; ++x) {
      const i = indexAt(x, y);
      const colour = stages.range[i] === null ? [255, 255, 255] : colourOf(i);
      image.data.set([...colour, 255], 4 * (y * columns + x));
    }
  context.putImageData(image, 0, 0);
}

function describe(x, y) {
  const i = indexAt(x, y), row = rows - 1 - y;
  const place = `row ${row} (${stages.elevation_deg[row].toFixed(2)}°, ${stages.points[row]} points), azimuth ` +
    `${(180 - 360 * (x + 0.5) / columns).toFixed(1)}°`;
  if (stages.range[i] === null) return `${place}: no return`;
  const part = stages.ground[i] ? "ground" : stages.cluster[i] < 0 ? "in no cluster" : `cluster ${stages.cluster[i]}`;
  const sharpness = stages.sharpness[i] === null ? "not defined" : `${stages.sharpness[i] / 1000} c_th`;
  return `${place}: ${(stages.range[i] / 1000).toFixed(3)} m, intensity ${stages.intensity[i] / 1000}, ${part}, ` +
    `roughness ${sharpness}, feature ${FEATURES[stages.feature[i]]}`;
}

const images = document.getElementById("images");
for (const [title, explanation, colourOf] of LAYERS) {
  images.insertAdjacentHTML("beforeend", `<h2>${title} &nbsp;<span>${explanation}</span></h2>`);
  const canvas = images.appendChild(document.createElement("canvas"));
  canvas.width = columns;
  canvas.height = rows;
  canvas.style.width = `${columns}px`;
  canvas.style.height = `${rows * height}px`;
  draw(canvas, colourOf);
  canvas.onmousemove = event => {
    const x = Math.min(Math.max(Math.floor(event.offsetX), 0), columns - 1);
    const y = Math.min(Math.max(Math.floor(event.offsetY / height), 0), rows - 1);
    document.getElementById("pixel").textContent = describe(x, y);
  };
}
const azimuth = [["180°", 0], ["90° left", 0.25], ["0° ahead", 0.5], ["−90° right", 0.75], ["−180°", 1]];
images.insertAdjacentHTML("beforeend", `<div id="azimuth" style="width:${columns}px">` +
  azimuth.map(([text, at]) => `<span style="left:${100 * at}%">${text}</span>`).join("") + "</div>");
