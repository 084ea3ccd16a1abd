// Texture units and bindings of uniform blocks, named once: shaders include this file, and so does
// Bindings.h for C++.

// Uniform blocks.
const int frameBinding = 0;     // lights.glsl, filled by the renderer
const int materialBinding = 2;  // what the fragment shader of a material reads

// Textures of btf.frag.
const int layerParametersUnit = 0;
const int sharedParametersUnit = 1;
const int triangleOfDirectionUnit = 2;
const int trianglesUnit = 3;
const int quadratureUnit = 4;
const int preparedParametersUnit = 5;
const int baseColorsUnit = 6;  // where parameters are filtered
const int coordinatesUnit = 7;  // of a coordinate map
const int firstTableUnit = 8;  // of a field's tables, as many as mostTables
const int mostTables = 8;

// Textures of pbr.frag, which is also the order of its placements, and of lambert.frag.
const int baseColorUnit = 0;
const int metallicRoughnessUnit = 1;
const int normalUnit = 2;
const int emissionUnit = 3;
const int occlusionUnit = 4;
const int specularUnit = 5;
const int specularColorUnit = 6;
const int clearcoatUnit = 7;
const int clearcoatRoughnessUnit = 8;
const int clearcoatNormalUnit = 9;
const int sheenColorUnit = 10;
const int sheenRoughnessUnit = 11;
const int anisotropyUnit = 12;
const int iridescenceUnit = 13;
const int iridescenceThicknessUnit = 14;
const int transmissionUnit = 15;
const int pbrUnitCount = 16;

const int panoramaUnit = 0;  // background.frag

// Textures of environment.glsl, beside those of every material.
const int environmentLobesUnit = 16;
const int environmentMomentsUnit = 17;
const int environmentGlossyUnit = 18;
const int microfacetTableUnit = 19;

// Textures of shadows.glsl, beside those.
const int shadowMapsUnit = 20;
const int shadowCubesUnit = 21;

const int sheenTableUnit = 22;  // sheen.glsl
