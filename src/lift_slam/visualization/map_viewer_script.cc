#include "lift_slam/visualization/map_viewer_script.h"

namespace lift_slam {

namespace {

constexpr char kScript[] = R"js(
(function () {
  "use strict";
  const box = document.getElementById("viewer"), canvas = box.querySelector("canvas");
  const context = canvas.getContext("2d"), select = box.querySelector("select");
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const scenes = JSON.parse(document.getElementById("viewer-data").textContent).map((s) => ({
    xyz: new Uint16Array(bytes(s.xyz)), gray: new Uint8Array(bytes(s.gray)), count: s.count,
    path: new Float32Array(bytes(s.path)), truth: new Float32Array(bytes(s.truth)),
    keyframes: new Float32Array(bytes(s.keyframes)), half: s.half, frustum: s.frustum}));
  const home = {azimuth: -0.45, elevation: 0.7};
  let view, scene, pending = false;

  // The start looks along the world's "up on the page", from behind and above the middle, from so
  // far that the path and most of the points are seen.
  function goHome() {
    view = {...home, target: middle(scene), distance: 0.1};
    const width = canvas.clientWidth, height = canvas.clientHeight, p = [0, 0, 0];
    const step = Math.max(1, Math.floor(scene.count / 2000)), path = scene.path;
    const inside = (project, x, y, z) => project(x, y, z, p) && p[0] > 0.04 * width &&
      p[0] < 0.96 * width && p[1] > 0.05 * height && p[1] < 0.92 * height;
    for (; view.distance < 4; view.distance *= 1.04) {
      const project = projector(width, height);
      let seen = 0, asked = 0, path_seen = true;
      for (let i = 0; i < scene.count; i += step, ++asked) {
        seen += inside(project, scene.xyz[3 * i] / 65535, scene.xyz[3 * i + 1] / 65535, scene.xyz[3 * i + 2] / 65535);
      }
      for (let i = 0; i < path.length && path_seen; i += 3) {
        path_seen = isNaN(path[i]) || inside(project, path[i], path[i + 1], path[i + 2]);
      }
      if (path_seen && seen >= 0.93 * asked) break;
    }
    redraw();
  }
  function show(index) { scene = scenes[index]; goHome(); }
  function middle(s) {
    const low = [9, 9, 9], high = [-9, -9, -9];
    const step = Math.max(1, Math.floor(s.count / 3000));
    const axis = [[], [], []];
    for (let i = 0; i < s.count; i += step) for (let k = 0; k < 3; ++k) axis[k].push(s.xyz[3 * i + k] / 65535);
    for (let k = 0; k < 3; ++k) {
      if (!axis[k].length) { low[k] = 0; high[k] = 1; continue; }
      axis[k].sort((a, b) => a - b);
      low[k] = axis[k][Math.floor(axis[k].length * 0.1)];
      high[k] = axis[k][Math.floor(axis[k].length * 0.9)];
    }
    return low.map((v, k) => 0.5 * (v + high[k]));
  }

  // Pixel and depth of a point in the unit box; nothing behind the eye.
  function projector(width, height) {
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth);
    const ce = Math.cos(view.elevation), se = Math.sin(view.elevation);
    const focal = 1.25 * Math.min(width, 1.35 * height), t = view.target;
    return (x, y, z, out) => {
      x -= t[0]; y -= t[1]; z -= t[2];
      const right = ca * x + sa * y, along = -sa * x + ca * y;
      const depth = along * ce - z * se + view.distance;
      const up = along * se + z * ce;
      out[2] = depth;
      if (depth < 0.02) return false;
      out[0] = 0.5 * width + focal * right / depth;
      out[1] = 0.5 * height - focal * up / depth;
      return true;
    };
  }

  function drawPoints(project, width, height, size) {
    const image = context.createImageData(width, height);
    const pixels = new Uint32Array(image.data.buffer), depths = new Float32Array(width * height).fill(1e9);
    pixels.fill(0xff1b1613);
    const p = [0, 0, 0];
    for (let i = 0; i < scene.count; ++i) {
      if (!project(scene.xyz[3 * i] / 65535, scene.xyz[3 * i + 1] / 65535, scene.xyz[3 * i + 2] / 65535, p)) continue;
      const g = 70 + scene.gray[i] * 0.6 | 0, color = 0xff000000 | g << 16 | g << 8 | g;
      const x0 = p[0] | 0, y0 = p[1] | 0;
      if (x0 < 0 || y0 < 0 || x0 > width - size || y0 > height - size) continue;
      for (let y = y0; y < y0 + size; ++y) for (let x = x0; x < x0 + size; ++x) {
        const k = y * width + x;
        if (p[2] < depths[k]) { depths[k] = p[2]; pixels[k] = color; }
      }
    }
    context.putImageData(image, 0, 0);
  }

  function drawPath(project, path, color, width) {
    const p = [0, 0, 0];
    let pen = false;
    context.beginPath();
    for (let i = 0; i < path.length; i += 3) {
      if (isNaN(path[i]) || !project(path[i], path[i + 1], path[i + 2], p)) { pen = false; continue; }
      if (pen) context.lineTo(p[0], p[1]); else context.moveTo(p[0], p[1]);
      pen = true;
    }
    context.strokeStyle = color; context.lineWidth = width; context.stroke();
  }

  // Keyframes as small pyramids that open along the viewing direction.
  function drawKeyframes(project, scale) {
    const k = scene.keyframes, size = scene.frustum, p = [0, 0, 0];
    context.beginPath();
    for (let i = 0; i + 11 < k.length; i += 12) {
      const corner = (a, b, c) => {
        const v = [0, 1, 2].map((j) => k[i + j] + size * (a * k[i + 3 + j] + b * k[i + 6 + j] + c * k[i + 9 + j]));
        return project(v[0], v[1], v[2], p) ? [p[0], p[1]] : null;
      };
      const [w, h] = scene.half, apex = corner(0, 0, 0);
      const base = [corner(-w, -h, 1), corner(w, -h, 1), corner(w, h, 1), corner(-w, h, 1)];
      if (!apex || base.includes(null)) continue;
      context.moveTo(...base[3]);
      for (const c of base) context.lineTo(...c);
      for (const c of base) { context.moveTo(...apex); context.lineTo(...c); }
    }
    context.strokeStyle = "#f3a63a"; context.lineWidth = scale; context.stroke();
  }

  function draw() {
    pending = false;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.max(2, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(2, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
    const project = projector(width, height);
    drawPoints(project, width, height, (ratio > 1.4 ? 3 : 2) + (scene.count < 2000 ? 1 : 0));
    if (scene.truth.length) drawPath(project, scene.truth, "#e8edf3", 2.4 * ratio);
    drawPath(project, scene.path, "#4aa8e8", 1.8 * ratio);
    drawKeyframes(project, ratio);
  }
  function redraw() { if (!pending) { pending = true; requestAnimationFrame(draw); } }

  function turn(dx, dy) {
    view.azimuth -= 0.008 * dx;
    view.elevation = Math.max(-1.55, Math.min(1.55, view.elevation + 0.008 * dy));
  }
  function move(dx, dy) {
    const f = view.distance / Math.min(canvas.clientWidth, 1.35 * canvas.clientHeight) / 1.25;
    const ca = Math.cos(view.azimuth), sa = Math.sin(view.azimuth);
    const se = Math.sin(view.elevation), ce = Math.cos(view.elevation);
    const right = [ca, sa, 0], up = [-sa * se, ca * se, ce];
    view.target = view.target.map((v, k) => v - f * dx * right[k] + f * dy * up[k]);
  }
  let drag = null;
  canvas.addEventListener("pointerdown", (e) => {
    drag = [e.clientX, e.clientY, e.button !== 0 || e.shiftKey];
    canvas.setPointerCapture(e.pointerId);
  });
  canvas.addEventListener("pointermove", (e) => {
    if (!drag) return;
    (drag[2] ? move : turn)(e.clientX - drag[0], e.clientY - drag[1]);
    drag[0] = e.clientX; drag[1] = e.clientY;
    redraw();
  });
  const drop = () => { drag = null; };
  canvas.addEventListener("pointerup", drop);
  canvas.addEventListener("pointercancel", drop);
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    view.distance = Math.max(0.05, Math.min(6, view.distance * Math.exp(0.0012 * e.deltaY)));
    e.preventDefault(); redraw();
  }, {passive: false});
  canvas.addEventListener("dblclick", goHome);
  canvas.addEventListener("keydown", (e) => {
    const keys = {ArrowLeft: [-12, 0], ArrowRight: [12, 0], ArrowUp: [0, -12], ArrowDown: [0, 12]};
    if (e.key === "+" || e.key === "-") view.distance *= e.key === "+" ? 0.9 : 1.1;
    else if (keys[e.key]) turn(...keys[e.key]);
    else return;
    e.preventDefault(); redraw();
  });
  if (select) select.addEventListener("change", () => show(select.selectedIndex));
  window.addEventListener("resize", redraw);
  show(0);
})();
)js";

}  // namespace

const char* MapViewerScript() { return kScript; }

}  // namespace lift_slam
