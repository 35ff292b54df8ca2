const FRAME = { slow: 60, fast: 25 }; // ms

// A canvas that is drawn when something changes. Clouds are drawn in parts, over several frames, the size of which the
// machine decides: while the view moves one sees the first part, at rest the others come in.
class View {
  constructor(element) {
    this.element = element;
    this.renderer = new THREE.WebGLRenderer({ antialias: false, preserveDrawingBuffer: true });
    this.renderer.setClearColor(0xffffff);
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.autoClear = false;
    element.append(this.renderer.domElement);
    this.camera = new THREE.PerspectiveCamera(40, 1, 0.1, 1e5);
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener("change", () => this.draw());
    this.scenes = [new THREE.Scene()]; // side by side
    this.lines = [];
    this.part = 100_000; // points of a cloud in one frame
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  resize() {
    const size = new THREE.Vector2(this.element.clientWidth, this.element.clientHeight);
    if (size.x === 0 || this.size?.equals(size)) return;
    this.size = size;
    this.renderer.setSize(size.x, size.y, false);
    this.camera.aspect = size.x / this.scenes.length / size.y;
    this.camera.updateProjectionMatrix();
    for (const material of this.lines) material.resolution.set(size.x / this.scenes.length, size.y);
    this.draw();
  }

  draw() {
    this.done = 0;
    this.waiting ??= requestAnimationFrame(now => this.frame(now));
  }

  frame(now) {
    const milliseconds = now - (this.last ?? -Infinity);
    if (milliseconds > FRAME.slow && milliseconds < 5000) this.part = Math.max(0.7 * this.part, 50_000);
    if (milliseconds < FRAME.fast) this.part *= 1.4;
    const end = this.done + Math.round(this.part);
    this.waiting = undefined;
    const more = this.render(this.done, end);
    this.done = end;
    this.last = more ? now : undefined;
    if (more) this.waiting = requestAnimationFrame(next => this.frame(next));
    else this.element.dataset.drawn = "true";
  }

  // Draws the points of the clouds from `begin` to `end`, on top of those before; true when there are more.
  render(begin, end) {
    if (!this.size) return false;
    delete this.element.dataset.drawn;
    const { renderer, scenes } = this, width = this.size.x / scenes.length;
    renderer.setScissorTest(scenes.length > 1);
    let more = false;
    scenes.forEach((scene, k) => {
      scene.traverse(({ isCloud, geometry }) => {
        if (!isCloud) return;
        const { count } = geometry.attributes.position;
        geometry.setDrawRange(Math.min(begin, count), Math.max(Math.min(end, count) - begin, 0));
        more ||= end < count;
      });
      renderer.setViewport(k * width, 0, width, this.size.y);
      renderer.setScissor(k * width, 0, width, this.size.y);
      if (begin === 0) renderer.clear();
      renderer.render(scene, this.camera);
    });
    this.onrender?.();
    return more;
  }

  // Looks at a sphere from this direction.
  look(target, radius, direction) {
    const half = Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2)) * Math.min(1, this.camera.aspect);
    this.controls.target.copy(target);
    this.camera.position.copy(direction).normalize().multiplyScalar(radius / half).add(target);
    this.camera.near = radius / 500;
    this.camera.far = radius * 200;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // One line through the points, or one from each other point to the next.
  addLine(points, colour, width, separate = false) {
    const geometry = separate ? new THREE.LineSegmentsGeometry() : new THREE.LineGeometry();
    geometry.setPositions(points);
    const material = new THREE.LineMaterial({ color: colour, linewidth: width, depthTest: false });
    this.lines.push(material);
    if (this.size) material.resolution.copy(this.size);
    const line = separate ? new THREE.LineSegments2(geometry, material) : new THREE.Line2(geometry, material);
    line.renderOrder = 1;
    this.scenes[0].add(line);
    return line;
  }

  addDots(points, colour, size) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    const material = new THREE.ShaderMaterial({
      uniforms: { colour: { value: new THREE.Color(colour) }, size: { value: size * window.devicePixelRatio } },
      vertexShader: `uniform float size;
        void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); gl_PointSize = size; }`,
      fragmentShader: `uniform vec3 colour;
        void main() {
          float r = 2.0 * distance(gl_PointCoord, vec2(0.5));
          if (r > 1.0) discard;
          gl_FragColor = vec4(r > 0.7 ? vec3(1.0) : colour, 1.0);
        }`,
      depthTest: false,
    });
    const dots = new THREE.Points(geometry, material);
    dots.renderOrder = 2;
    dots.frustumCulled = false;
    this.scenes[0].add(dots);
    return dots;
  }
}

// The map: the colour comes from the height, the intensity or the time by the uniform `mode`.
function mapCloud(map) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(decode(map.position), 3));
  geometry.setAttribute("intensity", new THREE.BufferAttribute(decode(map.intensity), 1, true));
  geometry.setAttribute("time", new THREE.BufferAttribute(decode(map.time), 1, true));
  geometry.setAttribute("above", new THREE.BufferAttribute(decode(map.above), 1));
  const material = new THREE.ShaderMaterial({
    uniforms: {
      mode: { value: 0 },
      size: { value: 2 },
      height: { value: new THREE.Vector2(...map.height) },
      aboveRange: { value: new THREE.Vector2(...map.aboveRange) },
      limit: { value: 1e6 },
      colours: { value: shadeTexture() },
    },
    vertexShader: `attribute float intensity, time, above;
      uniform int mode;
      uniform float size, limit;
      uniform vec2 height, aboveRange;
      varying float shade;
      float within(float value, vec2 range) { return (value - range.x) / max(range.y - range.x, 0.01); }
      void main() {
        vec4 place = modelMatrix * vec4(position, 1.0);
        shade = mode == 0 ? within(place.z, height) : mode == 1 ? within(0.01 * above, aboveRange)
          : mode == 2 ? intensity : time;
        gl_Position = projectionMatrix * viewMatrix * place;
        if (above > limit) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside
        gl_PointSize = size;
      }`,
    fragmentShader: `uniform sampler2D colours;
      varying float shade;
      void main() { gl_FragColor = texture2D(colours, vec2(clamp(shade, 0.002, 0.998), 0.5)); }`,
  });
  const cloud = new THREE.Points(geometry, material);
  cloud.position.set(...map.low);
  cloud.scale.setScalar(map.step);
  cloud.frustumCulled = false;
  cloud.isCloud = true;
  return cloud;
}

function scanCloud(points, step, colour) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  const material = new THREE.PointsMaterial({ color: colour, size: 1.6 * window.devicePixelRatio, sizeAttenuation: false });
  const cloud = new THREE.Points(geometry, material);
  cloud.frustumCulled = false;
  cloud.matrixAutoUpdate = false;
  cloud.unit = new THREE.Matrix4().makeScale(step, step, step);
  cloud.matrix.copy(cloud.unit);
  return cloud;
}
