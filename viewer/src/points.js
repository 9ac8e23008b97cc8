// Some of the particles: embers of burning fuel, grains of the rest.
import {
  BufferAttribute, BufferGeometry, CustomBlending, GLSL3, OneFactor, Points, RawShaderMaterial, Vector3,
} from 'three';
import {pointFragment, pointVertex} from './shaders.js';

export class Particles {
  constructor(colours) {
    this.uniforms = {
      lower: {value: new Vector3()}, extent: {value: new Vector3(1, 1, 1)}, size: {value: 600}, colours: {value: colours},
    };
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: pointVertex, fragmentShader: pointFragment, uniforms: this.uniforms,
      transparent: true, depthWrite: false, blending: CustomBlending, blendSrc: OneFactor, blendDst: OneFactor,
    });
    this.points = new Points(new BufferGeometry(), material);
    this.points.frustumCulled = false;
    this.points.visible = false;
  }

  set(points) {
    this.points.geometry.dispose();
    this.points.geometry = new BufferGeometry();
    this.isThere = Boolean(points);
    if (!points) return;
    this.points.geometry.setAttribute('position', new BufferAttribute(points.position, 3, true));
    this.points.geometry.setAttribute('heat', new BufferAttribute(points.heat, 1, true));
    this.points.geometry.setAttribute('kind', new BufferAttribute(Float32Array.from(points.kind), 1));
    this.uniforms.lower.value.set(...points.lower);
    this.uniforms.extent.value.set(...points.extent);
  }
}
