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
out vec2 place;
out vec3 way;

void main() {
    vec2 off = abs(corner.xy + at.xy * sides.x - eye.xy);
    float away = max(max(off.x, off.y), clear);
    float k = max(clamp((away - morphs.x) / (morphs.y - morphs.x), 0.0, 1.0), morphs.z);
    vec2 moved = at.xy - mod(at.xy, 2.0) * k;
    float height = heights.x + floor((heights.y - heights.x) * k + 0.5) - at.z;  // whole units: whatever the tile's base
    way = vec3(corner.xy + moved * sides.x, corner.z + height * sides.y) - eye;
    place = moved * texels.x + texels.y;
    float deep = dot(way, forward);
    gl_Position = vec4(dot(way, right) * lens.x, dot(way, up) * lens.y, deep - 2.0 * lens.z, deep);
}
