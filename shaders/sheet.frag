#version 330 core
// Premultiplied paint of a sheet.
in vec2 own;
out vec4 colour;
uniform sampler2D sheet;

void main() {
    colour = texture(sheet, own);
}
