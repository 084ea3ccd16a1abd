// KHR_materials_transmission: light that passes a surface which is infinitely thin.

layout(binding = transmissionUnit) uniform sampler2D transmissionTexture;

#ifdef TRANSMISSION
layout(location = 0, index = 1) out vec4 passing;  // what is behind is multiplied by it
#endif

// The share of what enters a dielectric that passes it.
float transmission() {
  float share = layerFactors.y;
#ifdef TRANSMISSION_TEXTURE
  share *= fetch(transmissionTexture, transmissionUnit).r;
#endif
  return share;
}
