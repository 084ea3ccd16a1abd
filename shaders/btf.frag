// A reflectance field under point and directional lights ([Meseth 2004] eq. 4) and an environment
// (5.2), in three stages, a file each: *where* the field is looked up, *fetch* what lies there, and
// *shade* it.
#version 450 core
#include "lights.glsl"
#include "environment.glsl"
#include "tangent_frame.glsl"
#include "shown.glsl"

in vec3 position;
in vec3 normal;
in vec3 tangent;
in vec2 texcoord;
flat in float handedness;

layout(location = 0) out vec4 color;

#include "surface.glsl"
#include "where.glsl"
#include "layer_lookup.glsl"
#include "fetch.glsl"
#include "model.glsl"
#include "shade.glsl"

void main() {
  TangentFrame frame = tangentFrame(normal, tangent, handedness, !gl_FrontFacing);
  EnvironmentFrame environment = environmentFrame(frame);
  vec3 view = toFrame(frame, toEye(position));
  Footprint footprint = footprintOf(texcoord * textureScale, surfaceSize());
  vec3 radiance = vec3(0.0);
  // Mesa's software renderer executes a loop's body once more to find that it has ended, unless the
  // test stands behind it. So do the loops over lights.
  int i = 0;
  do {
    PlaceShare at = placeAt(footprint, i);
    radiance += at.share * radianceOf(at.place, view, frame, environment);
  } while (++i < footprint.count);
  vec4 light = vec4(tint * max(radiance, 0.0), 1.0);  // shares may be below 0
  color = shownSurface(light, position, normal, texcoord * textureScale);
}
