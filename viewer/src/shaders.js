// The programs of the graphics card. Light is scene-linear throughout; the last pass develops it as the film is.

const posed = /* glsl */ `
uniform highp sampler2D poses, posesNext;
uniform float blend, explode;
uniform vec3 middle;
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
`;

export const pieceVertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform int colouring;
uniform vec3 ranges;  // largest speed, coldest and hottest temperature
in vec3 position, normal;
in vec2 uv;
in float body;
out vec3 place, around;
out vec2 texturePlace;
out vec4 tint;  // a: whether it counts
${posed}
vec3 hue(float h) { return clamp(abs(fract(h + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0); }
// Dark violet, crimson, orange, pale yellow: a fit of matplotlib's inferno, bright enough to be seen before the dark.
vec3 ramp(float t) {
  t = clamp(t, 0.0, 1.0);
  vec3 cold = mix(vec3(0.05, 0.09, 0.28), vec3(0.42, 0.06, 0.32), smoothstep(0.0, 0.35, t));
  vec3 warm = mix(vec3(0.86, 0.16, 0.05), vec3(1.0, 0.78, 0.25), smoothstep(0.6, 1.0, t));
  return mix(cold, warm, smoothstep(0.3, 0.65, t));
}
void main() {
  int row = int(body + 0.5);
  vec4 p = texelFetch(poses, ivec2(0, row), 0), q = texelFetch(poses, ivec2(1, row), 0);
  vec4 state = texelFetch(poses, ivec2(2, row), 0);
  vec4 pNext = texelFetch(posesNext, ivec2(0, row), 0), qNext = texelFetch(posesNext, ivec2(1, row), 0);
  float towards = pNext.w > 0.5 ? blend : 0.0;
  q = normalize(mix(q, dot(q, qNext) < 0.0 ? -qNext : qNext, towards));
  vec3 centre = mix(p.xyz, pNext.xyz, towards);
  bool moves = state.w > 0.5;
  if (moves) centre += (centre - middle) * explode;
  place = centre + turned(q, position);
  around = turned(q, normal);
  texturePlace = uv;
  tint = vec4(1.0, 1.0, 1.0, 0.0);
  if (moves && colouring == 1) {
    vec3 c = hue(state.z);
    tint = vec4(mix(vec3(dot(c, vec3(0.333))), c, 0.62) * 0.8 + 0.06, 1.0);
  }
  if (moves && colouring == 2) tint = vec4(ramp(sqrt(state.x / ranges.x)), 1.0);
  if (moves && colouring == 3) tint = vec4(ramp((state.y - ranges.y) / (ranges.z - ranges.y)), 1.0);
  gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
  if (p.w < 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // not there yet, or no more
}
`;

export const pieceFragment = /* glsl */ `
precision highp float;
in vec3 place, around;
in vec2 texturePlace;
in vec4 tint;
uniform sampler2D picture;
uniform vec3 colour, emission, eye, ambient, sky;
uniform highp sampler2D solidDepth;
uniform float shine, edge;
uniform int sunCount, lampCount;
uniform vec3 sunWays[2], sunLights[2];
uniform vec4 lamps[6];       // place, and how it falls off: 0 or 2
uniform vec3 lampLights[6];
layout(location = 0) out vec4 light;

vec3 facing() {
  vec3 flat_ = normalize(cross(dFdx(place), dFdy(place)));
  vec3 n = dot(around, around) > 0.25 ? normalize(around) : flat_;
  return dot(n, eye - place) < 0.0 ? -n : n;
}
vec3 skyAlong(vec3 way) {
  float up = smoothstep(-0.25, 0.9, way.y), horizon = exp(-14.0 * way.y * way.y);
  return sky * mix(0.35, 1.25, up) + sky * 1.1 * horizon;
}
// What reaches a surface: from all around (less from below), suns, lamps and fire; and what of it shines into the eye.
// One walk over the lights for both: programs are compiled sooner where a processor does it.
void gather(vec3 n, vec3 toEye, float sharpness, out vec3 arriving, out vec3 glints) {
  arriving = ambient * (0.72 + 0.28 * n.y);
  glints = vec3(0.0);
  vec3 back = reflect(-toEye, n);
  for (int k = 0; k < sunCount + lampCount; ++k) {
    bool isSun = k < sunCount;
    int l = isSun ? 0 : k - sunCount;
    vec3 way = isSun ? sunWays[k] : lamps[l].xyz - place;
    float square = isSun ? 1.0 : dot(way, way) + 0.02;
    vec3 light = isSun ? sunLights[k] : lampLights[l];
    bool fades = !isSun && lamps[l].w > 0.5;
    way *= inversesqrt(square);
    arriving += light * max(dot(n, way), 0.0) / (fades ? square : 1.0);
#ifndef PLAIN
    glints += light * pow(max(dot(back, way), 0.0), isSun ? sharpness : 0.25 * sharpness)
            * (isSun ? 1.0 : 0.6) / (fades ? 1.0 + square : 1.0);
#endif
  }
}
void main() {
  vec3 n = facing(), toEye = normalize(eye - place), arriving, glints;
#ifdef GLASS
  bool isClear = tint.a < 0.5;
  gather(n, toEye, isClear ? 220.0 : 40.0, arriving, glints);
  if (isClear) {
    if (texelFetch(solidDepth, ivec2(gl_FragCoord.xy), 0).r < gl_FragCoord.z) discard;
    float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(n, toEye), 0.0), 5.0);
    vec3 mirrored = skyAlong(reflect(-toEye, n));
    vec3 body = vec3(0.55, 0.85, 0.75) * arriving * edge;
    light = vec4(fresnel * mirrored + body * 0.3 + glints, min(1.0, 0.8 * fresnel + 0.3 * edge));
    return;
  }
#else
  gather(n, toEye, 40.0, arriving, glints);
#endif
  // Decoded here (a cubic near the curve of sRGB): cards without hardware decode every texel of a filter.
  vec3 code = texture(picture, texturePlace).rgb;
  vec3 painted = code * (code * (code * 0.305306011 + 0.682171111) + 0.012522878);
  vec3 own = tint.a > 0.5 ? tint.rgb : colour * painted;
  light = vec4(own * arriving + emission * painted + shine * glints, 1.0);
}
`;

export const pointVertex = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform vec3 lower, extent, sky;
uniform float size;
uniform sampler2D colours;
in vec3 position;
in float heat, kind;
out vec3 light;
void main() {
  vec4 seen = viewMatrix * vec4(lower + extent * position, 1.0);
  gl_Position = projectionMatrix * seen;
  bool burns = kind > 0.5 && kind < 1.5;
  vec3 glow = texture(colours, vec2((heat * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  light = (burns ? 2.5 * glow + vec3(0.5, 0.12, 0.02) : 0.6 * glow) + (kind > 1.5 ? 0.03 : 0.16) * vec3(0.9, 0.8, 0.7);
  gl_PointSize = clamp(size * (burns ? 0.022 : 0.015) / -seen.z, 1.0, 8.0);
}
`;

export const pointFragment = /* glsl */ `
precision highp float;
in vec3 light;
layout(location = 0) out vec4 colour;
void main() {
  vec2 p = 2.0 * gl_PointCoord - 1.0;
  float disc = 1.0 - smoothstep(0.3, 1.0, dot(p, p));
  if (disc < 0.05) discard;
  colour = vec4(light * disc, 0.0);
}
`;

export const screenVertex = /* glsl */ `
precision highp float;
in vec3 position;
out vec2 spot;
void main() {
  spot = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 1.0, 1.0);  // behind everything
}
`;

/** The gas along each view ray, front to back (src/render/gas_medium.h): what is before the nearest glass, and what is
    between it and the nearest opaque surface. */
export const gasFragment = /* glsl */ `
precision highp float;
precision highp sampler3D;
in vec2 spot;
uniform sampler3D cells, blocks;
uniform sampler2D colours, solidDepth, glassDepth;
uniform mat4 toWorld;     // from clip space
uniform vec3 eye, lower, upper, cellsPerBox, blocksPerBox, blockShare;
uniform float cell, opacity, minDensity, densityRange, emission, pace, phase;
uniform vec3 smokeColour, ambient, sunLight;
layout(location = 0) out vec4 before;  // light, and the share of light that passes
layout(location = 1) out vec4 behind;

float distanceAt(sampler2D depths, vec3 way) {
  float depth = texture(depths, spot).r;
  if (depth >= 1.0) return 1e9;
  vec4 p = toWorld * vec4(2.0 * vec3(spot, depth) - 1.0, 1.0);
  return dot(p.xyz / p.w - eye, way);
}
void main() {
  vec4 far = toWorld * vec4(2.0 * spot - 1.0, 1.0, 1.0);
  vec3 way = normalize(far.xyz / far.w - eye);
  vec3 perAxis = 1.0 / (way + vec3(equal(way, vec3(0.0))) * 1e-6);
  vec3 a = (lower - eye) * perAxis, b = (upper - eye) * perAxis;
  vec3 enter = min(a, b), leave = max(a, b);
  float near = max(max(enter.x, enter.y), max(enter.z, 0.0)), end = min(min(leave.x, leave.y), leave.z);
  before = behind = vec4(0.0, 0.0, 0.0, 1.0);
  if (near >= end) return;
  end = min(end, distanceAt(solidDepth, way));
  float glass = min(distanceAt(glassDepth, way), end);
  vec3 perMetre = way / (upper - lower), start = (eye - lower) / (upper - lower);
  float stride = pace * cell, skip = stride * 3.0;
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))) + phase);
  float t = near + stride * noise;
  vec3 light = vec3(0.0);
  float passes = 1.0;
  bool isBehind = t > glass;
  for (int n = 0; n < 320; ++n) {
    if (t >= end || passes < 0.01) break;
    if (!isBehind && t > glass) {
      before = vec4(light, passes);
      light = vec3(0.0);
      passes = 1.0;
      isBehind = true;
    }
    vec3 p = start + perMetre * t;
    vec4 block = texture(blocks, p * blockShare);
    if (block.a <= 0.002) { t += skip; continue; }
    vec2 sampled = texture(cells, p).rg;
    float share = sampled.r * sampled.r;
    float fade = min(share * 100.0, 1.0);
    float kappa = opacity * (minDensity * fade * fade * (3.0 - 2.0 * fade) + densityRange * share);
    float through = exp(-kappa * stride);
    vec3 glow = texture(colours, vec2((sampled.g * 255.0 + 0.5) / 256.0, 0.5)).rgb * emission;
    float fire = block.b / max(1.0 - block.b, 0.02);
    vec3 lit = smokeColour * (ambient * block.r + sunLight * block.g + 0.3 * fire * vec3(1.0, 0.42, 0.13));
    light += passes * (1.0 - through) * (glow + lit);
    passes *= through;
    t += stride;
  }
  if (isBehind) behind = vec4(light, passes);
  else before = vec4(light, passes);
}
`;

/** Halves a picture of the gas' light, for the glow around fire. */
export const blurFragment = /* glsl */ `
precision highp float;
in vec2 spot;
uniform sampler2D from, fromBehind;
uniform vec2 texel;
uniform float first;
layout(location = 0) out vec4 light;
vec3 taken(vec2 at) {
  vec4 a = texture(from, at);
  if (first < 0.5) return a.rgb;
  vec3 sum = a.rgb + a.a * texture(fromBehind, at).rgb;
  return max(sum - 0.6, 0.0) * 0.6;
}
void main() {
  vec3 sum = 0.25 * taken(spot);
  sum += 0.125 * (taken(spot + texel * vec2(1.5, 0.5)) + taken(spot + texel * vec2(-0.5, 1.5))
                + taken(spot + texel * vec2(-1.5, -0.5)) + taken(spot + texel * vec2(0.5, -1.5)));
  sum += 0.0625 * (taken(spot + texel * vec2(3.0, 2.0)) + taken(spot + texel * vec2(-2.0, 3.0))
                 + taken(spot + texel * vec2(-3.0, -2.0)) + taken(spot + texel * vec2(2.0, -3.0)));
  light = vec4(sum, 1.0);
}
`;

/** All layers one over another, and the tone curve of the film (src/render/image.cpp). */
export const developFragment = /* glsl */ `
precision highp float;
in vec2 spot;
uniform sampler2D solid, glass, before, behind, halo, halo2;
uniform highp sampler2D solidDepth;
uniform float exposure, hasGas;
uniform vec2 gasTexel, depthRange;
out vec4 shown;
float filmCurve(float x) {
  const float start = 0.35, room = 1.0 - start, white = (24.0 - start) / room;
  float s = (x - start) / room;
  return x <= start ? x : min(1.0, start + room * s * (1.0 + s / (white * white)) / (1.0 + s));
}
float metres(vec2 at) { return depthRange.x * depthRange.y / (depthRange.y - texture(solidDepth, at).r * (depthRange.y - depthRange.x)); }
// Of the four pixels of gas around, those whose rays ended at a like depth.
vec4 shares;
vec2 corner;
void chooseNeighbours() {
  vec2 place = spot / gasTexel - 0.5, whole = floor(place), part = place - whole;
  corner = (whole + 0.5) * gasTexel;
  shares = vec4((1.0 - part.x) * (1.0 - part.y), part.x * (1.0 - part.y), (1.0 - part.x) * part.y, part.x * part.y);
  float here = metres(spot);
  vec4 depths = vec4(metres(corner), metres(corner + gasTexel * vec2(1, 0)), metres(corner + gasTexel * vec2(0, 1)), metres(corner + gasTexel));
  vec4 apart = abs(depths - here) / (0.02 * here + 0.02);
  shares = (shares + 0.01) / (1.0 + apart * apart);
  shares /= dot(shares, vec4(1.0));
}
vec4 smoothed(sampler2D gas) {
#ifndef CAREFUL
  return texture(gas, spot);
#endif
  return shares.x * texture(gas, corner) + shares.y * texture(gas, corner + gasTexel * vec2(1, 0))
       + shares.z * texture(gas, corner + gasTexel * vec2(0, 1)) + shares.w * texture(gas, corner + gasTexel);
}
void main() {
  vec3 light = texture(solid, spot).rgb;
  vec4 g = texture(glass, spot);
  if (hasGas > 0.5) {
#ifdef CAREFUL
    chooseNeighbours();
#endif
    vec4 back = smoothed(behind), front = smoothed(before);
    light = light * back.a + back.rgb;
    light = light * (1.0 - g.a) + g.rgb;
    light = light * front.a + front.rgb;
    light += 0.10 * texture(halo, spot).rgb + 0.07 * texture(halo2, spot).rgb;
  } else {
    light = light * (1.0 - g.a) + g.rgb;
  }
  vec2 off = spot - 0.5;
  light *= exposure * (1.0 - 0.45 * dot(off, off));
  float peak = max(light.r, max(light.g, light.b));
  light = mix(light, vec3(dot(light, vec3(0.2126, 0.7152, 0.0722))), 0.30 * peak / (peak + 9.0));
  vec3 linear = vec3(filmCurve(light.r), filmCurve(light.g), filmCurve(light.b));
  vec3 code = mix(12.92 * linear, 1.055 * pow(max(linear, 1e-5), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  shown = vec4(code + (noise - 0.5) / 255.0, 1.0);
}
`;

export const skyFragment = /* glsl */ `
precision highp float;
in vec2 spot;
uniform mat4 toWorld;
uniform vec3 eye, sky;
layout(location = 0) out vec4 light;
void main() {
  vec4 far = toWorld * vec4(2.0 * spot - 1.0, 1.0, 1.0);
  vec3 way = normalize(far.xyz / far.w - eye);
  float up = smoothstep(-0.3, 0.8, way.y), horizon = exp(-10.0 * way.y * way.y);
  light = vec4(sky * (mix(0.5, 0.95, up) + 0.25 * horizon), 1.0);
}
`;
