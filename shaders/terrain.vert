#version 330
// A corner of a tile of land, on its way from the tile's own mesh to the coarser one it is a quarter of (Strugar's CDLOD).
// engine/terrain/seen/land_tiles.py has the same arithmetic: all sums before the eye is subtracted are exact.
in vec3 at;        // column, row, how far down it hangs
in vec2 heights;   // its own and the coarser corner's
uniform vec3 corner;
uniform vec2 sides;   // of a pixel, and of a unit of height
uniform vec3 eye;
uniform vec3 morphs;  // from where to where it becomes its parent; how far it is at least
uniform float clear;
uniform vec3 right;
uniform vec3 up;
uniform vec3 forward;
uniform vec3 lens;    // one over half the width and the height, at distance 1; the nearest that is drawn
uniform vec2 texels;  // of a quad, and before the first one, in parts of the picture
uniform float haze;
uniform float horizon;
uniform float brightest;
uniform vec3 sun;
out vec2 place;
out vec4 veil;  // what is seen of it before the land, and how much of the land

// The numbers of engine/terrain/daylight.py.
vec3 sky(vec3 d) {
    float k = exp(-4.5 * max(d.z, 0.0));
    float near = max(0.0, dot(d, sun));
    float glow = 0.16 * pow(near, 6.0) + 0.5 * pow(near, 64.0);
    return vec3(0.17 + 0.55 * k + glow, 0.31 + 0.42 * k + 0.74 * glow, 0.62 + 0.18 * k + 0.42 * glow);
}

// Haze, and the sky that the farthest land becomes: they change little from corner to corner.
vec4 veiled(vec3 way) {
    float t = length(way);
    vec3 d = way / max(t, 1e-9);
    float near = pow(max(0.0, dot(d, sun)), 5.0);
    float left = exp(-t / haze);
    float part = t / horizon;
    part *= part;
    float here = exp(-6.0 * part * part);
    vec3 before = vec3(0.60 + 0.26 * near, 0.69 + 0.14 * near, 0.82) * (1.0 - left);
    return 0.86 * vec4(mix(sky(d), before, here), left * here * brightest);
}

void main() {
    vec2 off = abs(corner.xy + at.xy * sides.x - eye.xy);
    float away = max(max(off.x, off.y), clear);
    float k = max(clamp((away - morphs.x) / (morphs.y - morphs.x), 0.0, 1.0), morphs.z);
    vec2 moved = at.xy - mod(at.xy, 2.0) * k;
    float height = heights.x + floor((heights.y - heights.x) * k + 0.5) - at.z;  // whole units: whatever the tile's base
    vec3 way = vec3(corner.xy + moved * sides.x, corner.z + height * sides.y) - eye;
    veil = veiled(way);
    place = moved * texels.x + texels.y;
    float deep = dot(way, forward);
    gl_Position = vec4(dot(way, right) * lens.x, dot(way, up) * lens.y, deep - 2.0 * lens.z, deep);
}
