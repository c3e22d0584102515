#include "view/shaders.h"

namespace karinui::glsl {
namespace {

// Where a fragment lies in the whole picture, the backdrop there, and the step to screen values.
const std::string kCommon = R"(
uniform vec3 backdrop;
uniform vec4 areaInPicture;  // left, bottom, width, height as fractions
uniform vec4 areaInPixels;
vec2 inPicture() { return areaInPicture.xy + (gl_FragCoord.xy - areaInPixels.xy) / areaInPixels.zw * areaInPicture.zw; }
uniform int allRound;
uniform vec3 lookRight, lookUp, lookAhead;
vec3 backdropHere() {
  if (allRound != 0) {  // darker from the horizon up to the ceiling, a little less down to the floor
    vec2 clip = inPicture() * 2.0 - 1.0;
    float rise = normalize(lookRight * clip.x + lookUp * clip.y + lookAhead).y;
    return backdrop * mix(vec3(1.0), vec3(0.66, 0.655, 0.645), rise > 0.0 ? smoothstep(0.0, 0.9, rise)
                                                                     : 0.10 + 0.5 * smoothstep(0.0, 0.9, -rise));
  }
  vec2 p = (inPicture() - vec2(0.5, 0.56)) * vec2(1.0, 1.05);
  float fall = smoothstep(0.08, 0.85, length(p));
  return backdrop * mix(vec3(1.0), vec3(0.66, 0.655, 0.645), fall);
}
float grain(vec2 p) { return fract(52.9829189 * fract(dot(p, vec2(0.06711056, 0.00583715)))); }
vec3 shown(vec3 c) {
  // A soft shoulder above 0.7 keeps lit cloth from burning out.
  vec3 over = max(c - 0.7, 0.0);
  c = min(c, 0.7) + 0.3 * over / (over + 0.3);
  vec3 s = mix(1.055 * pow(max(c, 1e-5), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
  return s + (grain(gl_FragCoord.xy) - 0.5) / 255.0;  // no banding in the backdrop
}
)";

// What body, cloth and floor are told of their place and of the lamps.
const std::string kLit = kCommon + R"(
in vec3 p, n, albedo;
in vec2 paper, soft;
in float cavity, strain;
uniform vec3 eye, keyTowards, keyRight, fillTowards;
uniform mat4 toKey;
uniform float keyTexel;  // metres
uniform sampler2DShadow keyMap;
out vec4 colour;

float keySeen(vec3 normal, float spread) {
  float turn = 6.2831853 * grain(gl_FragCoord.xy);
  mat2 spin = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  vec3 from = p + normal * (2.0 * keyTexel + 0.002) + keyTowards * (spread * 0.25);
  vec3 up = cross(keyTowards, keyRight);
  float sum = 0.0;
  for (int i = 0; i < KEY_LOOKS; ++i) {
    float r = sqrt((float(i) + 0.5) / float(KEY_LOOKS)), a = float(i) * 2.399963;
    vec2 o = spin * vec2(cos(a), sin(a)) * r * spread;
    sum += texture(keyMap, (toKey * vec4(from + keyRight * o.x + up * o.y, 1.0)).xyz * 0.5 + 0.5);
  }
  return sum / float(KEY_LOOKS);
}
)";

}  // namespace

const std::string kFine = "#define KEY_LOOKS 12\n#define WEAVE 1\n", kQuick = "#define KEY_LOOKS 3\n#define WEAVE 0\n";

const std::string kDepthVertex = R"(
layout(location = 0) in vec3 place;
uniform mat4 toLight;
void main() { gl_Position = toLight * vec4(place, 1.0); }
)";

const std::string kWholeVertex = R"(
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }
)";

const std::string kSkyFragment = R"(
uniform mat4 toLight;
uniform vec3 towards;
uniform float weight, lift, spread;
uniform int wide, floorFrom;  // texels in a row, the first vertex of the floor
uniform sampler2D places, normals;
uniform sampler2DShadow map;
out vec4 sum;
void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec3 normal = texelFetch(normals, texel, 0).xyz;
  float c = dot(normal, towards);
  vec3 from = texelFetch(places, texel, 0).xyz + (c > 0.0 ? normal : -normal) * lift + towards * lift;
  // The floor looks at a wider patch, or the shadows of the single directions would show as streaks.
  int looks = texel.y * wide + texel.x < floorFrom ? 1 : 13;
  float seen = 0.0;
  for (int i = 0; i < looks; ++i) {
    float r = spread * sqrt((float(i) - 0.5 * sign(float(i))) / 12.0), a = float(i) * 2.399963;
    vec3 p = from + vec3(r * cos(a), 0.0, r * sin(a));
    seen += texture(map, (toLight * vec4(p, 1.0)).xyz * 0.5 + 0.5);
  }
  float light = weight * abs(c) * seen / float(looks);
  sum = vec4(c > 0.0 ? light : 0.0, c > 0.0 ? 0.0 : light, 0.0, 0.0);  // for the outer side in x, for the inner side in y
}
)";

const std::string kBackdropFragment = kCommon + R"(
out vec4 colour;
void main() { colour = vec4(shown(backdropHere()), 1.0); }
)";

const std::string kSolidVertex = R"(
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 tint;
layout(location = 3) in vec2 flatPlace;
layout(location = 4) in vec2 cavityStrain;
uniform mat4 toClip;
uniform vec3 eye;
uniform float pushBack;
uniform sampler2D sky;
uniform int skyWide;
out vec3 p, n, albedo;
out vec2 paper, soft;
out float cavity, strain;
void main() {
  vec2 light = texelFetch(sky, ivec2(gl_VertexID % skyWide, gl_VertexID / skyWide), 0).xy;
  p = place; n = normal; albedo = tint; paper = flatPlace; soft = light;
  cavity = cavityStrain.x; strain = cavityStrain.y;
  // Along the ray of the eye: nothing moves in the picture, but cloth that lies within the stitches of the mesh on the
  // skin is drawn over it.
  vec3 ray = place - eye;
  gl_Position = toClip * vec4(place + ray * (pushBack / max(length(ray), 1e-6)), 1.0);
}
)";

const std::string kFloorFragment = kLit + R"(
void main() {
  // The floor is the backdrop itself, dimmed by what the body keeps away: no edge, only shadows and a pale disc.
  float unlit = 1.0 - soft.x;
  float shade = mix(1.0, keySeen(normalize(n), 0.03), 0.24) * (1.0 - 0.90 * clamp(unlit, 0.0, 1.0));
  float fade = 1.0 - smoothstep(0.5, 1.0, paper.x);
  float edge = max(fwidth(paper.x), 1e-5);
  float disc = 1.0 - smoothstep(-1.5, 1.5, (paper.x - 0.42) / edge);
  float rim = exp(-pow((paper.x - 0.42) / max(0.0035, 1.2 * edge), 2.0));
  vec3 base = backdropHere() * (1.0 + 0.055 * disc) * (1.0 - 0.10 * rim);
  colour = vec4(shown(base * mix(vec3(1.0), vec3(shade, shade * 0.985, shade * 0.96), fade)), 1.0);
}
)";

const std::string kSolidFragment = kLit + R"(
uniform float scaleTop;  // > 0: strain map
uniform bool cloth;      // or else skin
uniform int weave;       // ClothLook::Weave
uniform float threads, relief, gloss, sharpness, fuzz, cover;
uniform vec4 weaveAxes, printAxes;  // on paper: across, along
uniform int print;       // ClothLook::Print
uniform vec3 ink;
uniform vec2 repeat;     // metres across and along
uniform vec2 printOrigin;  // on paper
uniform bool ownWrong;     // the inner side has a colour and a print of its own
uniform int wrongPrint;
uniform vec3 wrongColour, wrongInk;
uniform sampler2D strainTable, yarnTable, photo;

// Uneven yarns along warp and weft, each scale fading out before it would flicker.
float noise(vec2 q) {
  vec2 i = floor(q), f = fract(q);
  return texture(yarnTable, (i + f * f * (3.0 - 2.0 * f) + 0.5) / float(textureSize(yarnTable, 0).x)).r;
}

float yarns(float w) {
  float sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    float size = k == 0 ? 0.0012 : (k == 1 ? 0.0032 : 0.008);
    float keep = 1.0 - smoothstep(0.3, 0.9, w / size);
    vec2 q = paper / size;
    sum += keep * (noise(q * vec2(1.0, 0.09)) + noise(q * vec2(0.09, 1.0)) - 1.0) * (k == 0 ? 0.5 : 0.42);
  }
  return sum;
}

float kept(float w, float size) { return 1.0 - smoothstep(0.25, 0.8, w / size); }

// How threads darken (-1) and lighten (1) the cloth; q lies along warp (y) and weft (x).
float threadShade(vec2 q, float w) {
  if (weave <= 1) return yarns(w);
  if (weave == 2) {  // linen: thick places in both yarns, centimetres long
    float s = kept(w, 0.0016) * 0.5 * (noise(q / vec2(0.0016, 0.03)) + noise(q / vec2(0.03, 0.0016)) - 1.0);
    s += kept(w, 0.003) * (smoothstep(0.62, 0.9, noise(q / vec2(0.0024, 0.06))) + smoothstep(0.62, 0.9, noise(q / vec2(0.07, 0.0024)))) * 0.34;
    return s + kept(w, 0.02) * 0.35 * (noise(q / 0.03) - 0.5) - 0.1;
  }
  if (weave == 3) {  // twill: lines from lower left to upper right, and streaks of uneven dye along the warp
    float line = sin(6.2831853 * (q.x + q.y * 0.72) / threads) * kept(w, threads * 0.5);
    float streak = noise(q / vec2(0.0022, 0.22)) + 0.7 * noise(q / vec2(0.006, 0.5)) - 0.85;
    return 0.42 * line + 0.95 * streak * kept(w, 0.004) + 0.3 * (noise(q / 0.05) - 0.5);
  }
  if (weave == 4) {  // herringbone: twill that turns every band, with flecks of other yarns
    float band = q.x / threads, side = abs(fract(band * 0.5) - 0.5) * 4.0 - 1.0;
    float line = sin(6.2831853 * (side * 0.5 * 1.6 + q.y / (threads * 0.42)));
    float fleck = smoothstep(0.78, 0.95, noise(q / vec2(0.0028, 0.0045))) - smoothstep(0.80, 0.96, noise(q / vec2(0.0045, 0.0028) + 17.0));
    return 0.55 * line * kept(w, threads * 0.2) + 0.9 * fleck * kept(w, 0.003) + 0.45 * (noise(q / 0.004) - 0.5) * kept(w, 0.004);
  }
  if (weave == 5) {  // knit: wales of little Vs, and yarn that took the dye unevenly
    float wale = abs(fract(q.x / threads) - 0.5) * 2.0;
    float vee = sin(6.2831853 * (q.y / threads * 1.25 + 0.6 * wale));
    float s = (0.55 * vee + 0.8 * (wale - 0.5)) * kept(w, threads * 0.6);
    return s + 0.7 * (noise(q / vec2(0.004, 0.0013)) - 0.5) * kept(w, 0.0022) + 0.25 * (noise(q / 0.012) - 0.5);
  }
  if (weave == 7) return (sin(6.2831853 * q.x / threads) + sin(6.2831853 * q.y / threads)) * 0.5 * kept(w, threads);
  if (weave == 8) return (noise(q / 0.004) - 0.5 + 0.9 * (noise(q / vec2(0.03, 0.05)) - 0.5)) * kept(w, 0.004);
  return (noise(q / vec2(0.0012, 0.03)) - 0.5) * kept(w, 0.0016);  // satin: floating threads
}

// Leather's grain: rounded cells, the nearest two of the points strewn over a lattice.
float cells(vec2 q) {
  vec2 i = floor(q), f = fract(q);
  float one = 9.0, two = 9.0;
  for (int k = 0; k < 9; ++k) {
    vec2 o = vec2(float(k % 3) - 1.0, float(k / 3) - 1.0), c = i + o;
    vec2 d = o + vec2(noise(c * 1.73 + 0.5), noise(c * 2.31 + 31.5)) - f;
    float m = dot(d, d);
    two = min(two, max(one, m)), one = min(one, m);
  }
  return smoothstep(0.02, 0.32, sqrt(two) - sqrt(one));
}

// A stripe of half its repeat, seen through a pixel w wide: never a moire.
float stripe(float s, float share, float w) {
  float t = abs(fract(s) - 0.5) * 2.0, soft = clamp(w * 2.0, 1e-4, 1.0);
  return mix(1.0 - smoothstep(share - soft, share + soft, t), share, smoothstep(0.4, 1.0, w));
}

vec3 printed(vec3 base, int print, vec3 ink) {
  if (print == 0) return base;
  vec2 from = paper - printOrigin;
  vec2 q = vec2(dot(from, printAxes.xy), dot(from, printAxes.zw)) / repeat;
  vec2 w = fwidth(q);
  if (print == 1) return mix(base, ink, stripe(q.x, 0.42, w.x));
  if (print == 2) {  // warp and weft stripes: where both meet the ink is full, else half of it is seen
    float a = stripe(q.x, 0.5, w.x), b = stripe(q.y, 0.5, w.y);
    return mix(base, ink, 0.5 * (a + b));
  }
  if (print == 3) {  // each second row is shifted by half
    vec2 even = q, odd = q + 0.5;
    vec2 a = fract(even) - 0.5, b = fract(odd) - 0.5;
    float soft = max(w.x, w.y), r = min(length(a), length(b));
    float dot1 = 1.0 - smoothstep(0.19 - soft, 0.19 + soft, r);
    return mix(base, ink, mix(dot1, 0.2268, smoothstep(0.4, 1.0, soft)));
  }
  return texture(photo, vec2(q.x, -q.y)).rgb;
}

void main() {
  vec3 v = normalize(eye - p);
  vec3 normal = normalize(n);
  bool inner = cloth && !gl_FrontFacing;
  if (inner) normal = -normal;
  float open = inner ? soft.y : soft.x;
  float hollow = inner ? -cavity : cavity;

  float w = max(length(fwidth(paper)), 1e-6);
  bool mapped = cloth && scaleTop > 0.0;
  bool look = cloth && !mapped;
  vec2 q = vec2(dot(paper, weaveAxes.xy), dot(paper, weaveAxes.zw));
  bool wrong = inner && look && ownWrong;
  vec3 base = wrong ? printed(wrongColour, wrongPrint, wrongInk) : look ? printed(albedo, print, ink) : albedo;
  if (inner && !wrong && look && weave == 3 && relief > 0.3) base = mix(base, vec3(0.62, 0.64, 0.66), 0.45);  // denim's white weft
  if (inner && !wrong) base = mix(base, vec3(dot(base, vec3(0.3, 0.55, 0.15))), 0.35) * 0.62;
  if (mapped) {
    base = strain < 0.0 ? vec3(0.5) : texture(strainTable, vec2(clamp(strain / scaleTop, 0.0, 1.0) * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
    if (inner) base *= 0.75;
  } else if (WEAVE == 1 && look && weave == 9) {
    float grain1 = cells(q / threads), keep = kept(w, threads * 0.5);
    base *= 1.0 - relief * (1.0 - grain1) * keep + 0.25 * (noise(q / 0.05) - 0.5);
    // The grain tilts the shine.
    normal = normalize(normal + 0.5 * keep * (vec3(noise(q / 0.0022), noise(q / 0.0022 + 9.0), noise(q / 0.0022 + 23.0)) - 0.5));
  } else if (WEAVE == 1 && look && weave >= 0) {
    base *= 1.0 + relief * threadShade(q, w);
  }
  float dents = clamp(1.0 - 0.75 * max(hollow, 0.0) + 0.2 * max(-hollow, 0.0), 0.4, 1.2);

  float wrap = !cloth ? 0.22 : 0.10;
  float facing = dot(normal, keyTowards);
  float lit = clamp((facing + wrap) / (1.0 + wrap), 0.0, 1.0);
  float seen = lit > 0.0 ? keySeen(normal, 0.011) : 0.0;
  vec3 key = vec3(1.0, 0.955, 0.89) * lit * seen;
  if (!cloth) key += vec3(0.10, 0.025, 0.012) * seen * clamp(1.0 - abs(facing) * 2.5, 0.0, 1.0);
  vec3 fill = vec3(0.90, 0.95, 1.0) * max(dot(normal, fillTowards), 0.0) * mix(0.45, 1.0, open);
  vec3 above = mix(vec3(0.80, 0.74, 0.66), vec3(1.0, 0.99, 0.98), normal.y * 0.5 + 0.5);
  float bounce = (0.5 - 0.5 * normal.y) * 0.22;
  vec3 ambient = above * (0.16 + open * 1.1 + bounce * mix(0.4, 1.0, open));
  vec3 light = mapped ? vec3(0.36) + 0.40 * key + 0.16 * fill + 0.42 * ambient
                      : !cloth ? 0.66 * key + 0.14 * fill + 0.44 * ambient
                      : 0.82 * key + 0.17 * fill + 0.50 * ambient;
  vec3 c = base * light * (mapped ? mix(1.0, dents, 0.8) : dents);

  // The rim light from behind draws the silhouette; cloth's fine hairs catch more of it than skin.
  float graze = pow(1.0 - clamp(dot(normal, v), 0.0, 1.0), 3.5);
  c += (look ? min(fuzz, 0.3) : cloth ? 0.16 : 0.07) * graze * mix(base, vec3(0.9, 0.88, 0.84), 0.45) * (0.25 + 0.75 * open) * (inner || mapped ? 0.25 : 1.0);
  if (!cloth) {
    vec3 h = normalize(v + keyTowards);
    c += vec3(0.045) * pow(max(dot(normal, h), 0.0), 18.0) * seen;
  }
  float seenThrough = 1.0;
  if (look) {
    float nv = clamp(dot(normal, v), 0.0, 1.0);
    if (gloss > 0.0) {  // the key lamp, and a large soft window opposite to it
      vec3 h = normalize(v + keyTowards), f = normalize(v + fillTowards);
      float key1 = pow(max(dot(normal, h), 0.0), sharpness) * seen, fill1 = pow(max(dot(normal, f), 0.0), sharpness * 0.6);
      vec3 tint = weave == 6 ? mix(base * 1.5, vec3(1.0), 0.35) : vec3(1.0);  // silk shines in its own colour
      c = c * (1.0 - 0.28 * gloss) + gloss * (0.62 * key1 + 0.26 * fill1 * open) * tint;
      c += 0.35 * gloss * pow(1.0 - nv, 4.0) * base * open;
    }
    if (fuzz > 0.5) {  // a pile: dark where one looks into it, light where it is seen from the side
      c *= mix(1.25, 0.40, nv * nv);
      c += fuzz * pow(1.0 - nv, 2.2) * (0.55 * base + 0.02) * (0.3 + 0.7 * open);
    }
    seenThrough = clamp(cover + (1.0 - cover) * pow(1.0 - nv, 1.6), 0.0, 1.0);
  }
  colour = vec4(shown(c), seenThrough);
}
)";

const std::string kRibbonVertex = R"(
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 place;
layout(location = 3) in vec2 halfWidth;
layout(location = 4) in vec2 alongBoth;
layout(location = 5) in vec3 tint;
layout(location = 6) in float lift;
layout(location = 7) in vec2 stitch;
uniform mat4 toClip;
uniform vec3 eye;
uniform float pixelsPerMetre;  // at one metre's distance, in the whole picture
uniform float leastPixels;     // half width of the thinnest line
out vec3 paint;
out vec4 spot;      // metres along and across from `from`, length of the piece, half width
out vec2 alongLine; // metres along the line at this end, and here
flat out vec2 sewn;
void main() {
  vec3 here = place.x < 0.5 ? from : to;
  vec3 ray = here - eye;
  float away = max(length(ray), 1e-6);
  float least = leastPixels * away / pixelsPerMetre;
  bool pointed = halfWidth.x != halfWidth.y;
  float wide = place.x < 0.5 ? halfWidth.x : halfWidth.y;
  if (!pointed) wide = max(wide, least);
  vec3 run = normalize(to - from);
  vec3 side = cross(run, ray / away);
  side = length(side) > 1e-4 ? normalize(side) : vec3(0.0);
  float cap = pointed ? 0.0 : wide;  // room for round ends
  float s = place.x < 0.5 ? -cap : length(to - from) + cap;
  vec3 at = from + run * s + side * (wide * place.y);
  vec3 sight = at - eye;
  at -= sight * min(lift / max(length(sight), 1e-6), 0.5);
  gl_Position = toClip * vec4(at, 1.0);
  paint = tint;
  spot = vec4(s, pointed ? 0.0 : wide * place.y, length(to - from), max(wide, 1e-6));
  alongLine = vec2(alongBoth.x + s, 0.0);
  sewn = stitch;
}
)";

const std::string kRibbonFragment = kCommon + R"(
in vec3 paint;
in vec4 spot;
in vec2 alongLine;
flat in vec2 sewn;
out vec4 colour;
void main() {
  float past = max(max(-spot.x, spot.x - spot.z), 0.0);
  if (length(vec2(past, spot.y)) > spot.w) discard;
  if (sewn.x > 0.0) {
    // A thread lies on the cloth in the middle of a stitch and dives into it at both ends.
    float in1 = mod(alongLine.x, sewn.x + sewn.y);
    if (in1 > sewn.x) discard;
  }
  float round1 = 1.0 - 0.25 * pow(abs(spot.y) / spot.w, 2.0);
  colour = vec4(shown(paint * round1), 1.0);
}
)";

}  // namespace karinui::glsl
