#version 330 core
// What lies under the paint: a quiet chequerboard, light inside the frame and dark outside, and the frame's edge.
in vec2 screen;
out vec4 colour;
uniform vec2 middle;    // screen point of the view's centre
uniform vec4 inverse;   // rows of the matrix from screen to canvas directions
uniform vec2 cell;      // sides of the coarse and the fine squares, screen pixels
uniform vec4 phase;     // where the centre lies in the coarse (xy) and fine (zw) pattern, in squares
uniform float blend;    // 0 shows the coarse squares, 1 the fine ones
uniform vec4 frame;     // left, top, right, bottom of the frame seen from the centre, screen pixels before turning
uniform vec3 light;
uniform vec3 dark;

float squares(vec2 at) {
    vec2 f = floor(at);
    return mod(f.x + f.y, 2.0);
}

void main() {
    vec2 d = screen - middle;
    vec2 at = vec2(dot(inverse.xy, d), dot(inverse.zw, d));
    float s = mix(squares(at / cell.x + phase.xy), squares(at / cell.y + phase.zw), blend);
    vec2 inner = min(at - frame.xy, frame.zw - at);
    float depth = min(inner.x, inner.y);  // inside the frame: how far from its edge
    vec3 paper = light - vec3(0.045) * s;
    vec3 desk = dark - vec3(0.012) * s;
    float shadow = 0.16 * exp(-max(-depth, 0.0) / 7.0);
    colour = vec4(mix(desk * (1.0 - shadow), paper, clamp(depth + 0.5, 0.0, 1.0)), 1.0);
}
