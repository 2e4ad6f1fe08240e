// Places a corner of a square tile of terrain: kTileQuads quads a side, and a skirt around it that
// hides the gap to a neighbour of another fineness.
uniform sampler2D ground_map;
layout(location = 0) in vec4 tile;  // xy: south-west corner relative to the eye [m]; side of a quad [m]; mip
out vec3 offset_eye;
out float depth;  // along the view [m]

void main() {
  const int kSide = kTileQuads + 3;
  int row = gl_VertexID / kSide, column = gl_VertexID - row * kSide;
  ivec2 corner = ivec2(column, row) - 1, inside = clamp(corner, ivec2(0), ivec2(kTileQuads));
  vec2 xy = clamp(tile.xy + tile.z * vec2(inside), ground_area.xy, ground_area.zw);
  float height = textureLod(ground_map, xy * ground_place.zw + ground_place.xy, tile.w).a - ground_noise.w;
  if (corner != inside) height -= 2.0 * tile.z;
  height -= dot(xy, xy) / (2.0 * kEarthRadius);
  offset_eye = vec3(xy, height) - eye.xyz;
  gl_Position = clip_from_world * vec4(xy, height, 1.0);
  depth = gl_Position.w;
  gl_Position.z = -kNearest;
}
