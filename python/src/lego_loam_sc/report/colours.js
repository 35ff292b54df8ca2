"use strict";
// Light for the ground, which is most of a map and has the trajectories on it, dark for what stands up: ColorBrewer's
// YlGnBu without its lightest end, which white paper would swallow.
const SCALE = [[178, 222, 184], [127, 205, 187], [65, 182, 196], [29, 145, 192], [34, 94, 168], [37, 52, 148], [8, 29, 88]];
const COLOUR = { live: "#d9480f", final: "#1a1a1a", accepted: "#c2007a", refused: "#8a8a8a", match: "#1c6fb5",
  query: "#e8590c", here: "#d00000" };

function shade(t) {
  const at = Math.min(Math.max(t, 0), 0.9999) * (SCALE.length - 1), k = Math.floor(at);
  return SCALE[k].map((value, channel) => value + (at - k) * (SCALE[k + 1][channel] - value));
}

function shadeTexture() {
  const bytes = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) bytes.set([...shade(i / 255), 255], 4 * i);
  const texture = new THREE.DataTexture(bytes, 256, 1, THREE.RGBAFormat);
  texture.magFilter = texture.minFilter = THREE.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

const ARRAYS = { u1: Uint8Array, u2: Uint16Array, i2: Int16Array, f4: Float32Array };

function decode({ type, bytes }) {
  const text = atob(bytes), raw = new Uint8Array(text.length);
  for (let i = 0; i < raw.length; ++i) raw[i] = text.charCodeAt(i);
  return new ARRAYS[type](raw.buffer);
}
