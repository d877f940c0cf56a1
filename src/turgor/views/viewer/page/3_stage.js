// Stage: renderer, camera, light, and the groups that are drawn for every image of the modeled part.

const INK = 0x262b34;
const AZIMUTH = (20 * Math.PI) / 180; // the direction of the still pictures
const SMOOTH = 1000 / 30; // milliseconds between two frames that look like motion
const ROUGH = 0.5; // share of the pixels in each direction that is drawn while the picture turns too slowly
const ELEVATION = (18 * Math.PI) / 180;

// Whether a processor draws in place of a graphics card. It is some fifty times slower, so the viewer asks less of it.
function drawsInSoftware() {
  const probe = document.createElement("canvas").getContext("webgl2");
  const extension = probe?.getExtension("WEBGL_debug_renderer_info");
  const name = extension ? probe.getParameter(extension.UNMASKED_RENDERER_WEBGL) : "";
  probe?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

class Stage {
  constructor(box) {
    this.box = box;
    this.slow = drawsInSoftware();
    this.renderer = new THREE.WebGLRenderer({ antialias: !this.slow, stencil: true, preserveDrawingBuffer: true });
    this.ratio = this.slow ? 1 : Math.min(2, window.devicePixelRatio || 1);
    this.renderer.setPixelRatio(this.ratio);
    this.renderer.setClearColor(0xffffff, 1);
    this.renderer.localClippingEnabled = true;
    box.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -10, 10);
    this.camera.up.set(0, 0, 1);
    this.matrices = [];
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.enableZoom = false; // until the picture was clicked, so that the page scrolls past it
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => this.turn(true));
    this.controls.addEventListener("end", () => this.turn(false));
    box.addEventListener("pointerdown", () => (this.controls.enableZoom = true));
    box.addEventListener("pointerleave", () => (this.controls.enableZoom = false));
    this.ambient = new THREE.AmbientLight(0xffffff, 1);
    this.lamp = new THREE.DirectionalLight(0xffffff, 1);
    this.scene.add(this.ambient, this.lamp, this.lamp.target);
    this.light(true);
    this.frames = 0;
    this.listeners = [];
    this.faint = []; // what is left out while the picture turns too slowly
    this.rough = false;
    this.waiting = false;
    new ResizeObserver(() => this.fit()).observe(box);
  }

  // The maps of the modeled part onto all parts of the whole.
  images(rows) {
    this.matrices = rows.map((each) => new THREE.Matrix4().set(...each));
  }

  // Remove what is drawn, and free what the graphics card has of it.
  clear() {
    const lights = [this.ambient, this.lamp, this.lamp.target];
    for (const each of this.scene.children.filter((child) => !lights.includes(child))) {
      this.scene.remove(each);
      each.geometry?.dispose();
      each.material?.dispose();
    }
    this.faint = [];
    this.hidden = [];
  }

  // Where the camera looks from.
  get direction() {
    const away = this.camera.position.clone().sub(this.controls.target).normalize();
    const { position, zoom } = this.camera;
    return {
      azimuth: Math.atan2(away.x, -away.y), elevation: Math.asin(Math.max(-1, Math.min(1, away.z))),
      position: position.clone(), target: this.controls.target.clone(), zoom,
    };
  }

  // Look from where the camera was.
  restore({ position, target, zoom }) {
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.camera.zoom = zoom;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // Show an object once for each image of the modeled part.
  repeat(make) {
    return this.matrices.map((matrix, k) => {
      const made = make(k);
      made.matrixAutoUpdate = false;
      made.matrix.copy(matrix);
      made.matrixWorldNeedsUpdate = true;
      this.scene.add(made);
      return made;
    });
  }

  // With light the colors are a little darker where the surface turns away; without, they are those of the bar.
  light(on) {
    this.ambient.intensity = Math.PI * (on ? 0.55 : 1);
    this.lamp.intensity = Math.PI * (on ? 0.48 : 0);
    this.draw();
  }

  // Aim at points (x, y, z after each other) so that they fill the picture.
  frame(cloud) {
    this.cloud = cloud;
    const box = new THREE.Box3().setFromArray(cloud);
    this.center = box.getCenter(new THREE.Vector3());
    this.radius = box.min.distanceTo(box.max) / 2;
    this.look(AZIMUTH, ELEVATION);
  }

  look(azimuth, elevation) {
    const radius = this.radius;
    const away = new THREE.Vector3(
      Math.sin(azimuth) * Math.cos(elevation),
      -Math.cos(azimuth) * Math.cos(elevation),
      Math.sin(elevation),
    );
    this.camera.position.copy(this.center).addScaledVector(away, 4 * radius);
    this.camera.near = -20 * radius;
    this.camera.far = 30 * radius;
    this.camera.zoom = 1;
    this.camera.lookAt(this.center);
    this.camera.updateMatrixWorld();
    const seen = this.#seen();
    const shift = seen.getCenter(new THREE.Vector3()).setZ(0).transformDirection(this.camera.matrixWorld);
    const way = seen.getCenter(new THREE.Vector3()).setZ(0).length();
    this.camera.position.addScaledVector(shift, way);
    this.controls.target.copy(this.center).addScaledVector(shift, way);
    this.across = (seen.max.x - seen.min.x) / 2;
    this.upward = (seen.max.y - seen.min.y) / 2;
    this.fit();
    this.controls.update();
    this.draw();
  }

  // Box of the points as the camera sees them.
  #seen() {
    const box = new THREE.Box3();
    const place = new THREE.Vector3();
    for (let k = 0; k < this.cloud.length; k += 3) {
      box.expandByPoint(place.fromArray(this.cloud, k).applyMatrix4(this.camera.matrixWorldInverse));
    }
    return box;
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.box;
    if (!width || !height || !this.across) return;
    this.renderer.setSize(width, height);
    const half = 1.06 * Math.max(this.upward, (this.across * height) / width);
    this.camera.top = half;
    this.camera.bottom = -half;
    this.camera.right = (half * width) / height;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  // Length of a pixel [m].
  get pixel() {
    return (this.camera.top - this.camera.bottom) / this.camera.zoom / Math.max(1, this.box.clientHeight);
  }

  // Draw at the next frame of the browser; several calls before it give one drawing.
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame((time) => {
      this.waiting = false;
      if (this.turning) this.#watch(time);
      this.now();
    });
  }

  // While a user turns the picture or moves along the path, frames that come too slowly are drawn roughly; at rest all is
  // drawn again.
  turn(on) {
    this.turning = on;
    this.late = 0;
    this.before = null;
    this.#draft(on && this.slow);
  }

  // Draw roughly while a source moves, where a processor draws; without it all is drawn again.
  quick(on) {
    this.#draft(on && this.slow);
  }

  // Two frames after each other that are late, and not because the pointer rested, make the next ones rough.
  #watch(time) {
    const passed = this.before === null ? 0 : time - this.before;
    this.before = time;
    this.late = passed > SMOOTH && passed < 10 * SMOOTH ? this.late + 1 : 0;
    if (this.late > 1) {
      this.slow = true; // the next turn begins so
      this.#draft(true);
    }
  }

  #draft(on) {
    if (on === this.rough) return;
    this.rough = on;
    this.hidden?.forEach((each) => (each.visible = true));
    this.hidden = on ? this.faint.filter((each) => each.visible) : [];
    this.hidden.forEach((each) => (each.visible = false));
    this.renderer.setPixelRatio(on ? ROUGH * this.ratio : this.ratio);
    this.draw();
  }

  now() {
    this.lamp.position.copy(this.camera.position);
    this.lamp.target.position.copy(this.controls.target);
    this.renderer.render(this.scene, this.camera);
    this.frames++;
    this.listeners.forEach((listener) => listener());
  }
}
