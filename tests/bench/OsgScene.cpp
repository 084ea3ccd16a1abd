#include "OsgScene.h"

#include <epoxy/gl.h>

#include <osg/CullFace>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/Texture2D>
#include <osgViewer/Viewer>

#include "CompatibilityContext.h"

namespace weft::bench {
namespace {

/// What lambert.frag computes for one directional light, as one writes it for OpenSceneGraph.
constexpr const char* kVertexShader = R"(
#version 150 compatibility
out vec3 normal;
out vec2 texcoord;
void main() {
  normal = gl_NormalMatrix * gl_Normal;
  texcoord = gl_MultiTexCoord0.xy;
  gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";
constexpr const char* kFragmentShader = R"(
#version 150 compatibility
uniform sampler2D image;
uniform vec3 towardsLight;
in vec3 normal;
in vec2 texcoord;
void main() {
  gl_FragColor = vec4(texture(image, texcoord).rgb * max(dot(normalize(normal), towardsLight), 0.0), 1.0);
})";

osg::ref_ptr<osg::Geometry> geometryOf(const Mesh& mesh) {
  const osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array, normals = new osg::Vec3Array;
  const osg::ref_ptr<osg::Vec2Array> texcoords = new osg::Vec2Array;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    vertices->push_back({mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z});
    normals->push_back({mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z});
    texcoords->push_back({mesh.texcoords[i].x, mesh.texcoords[i].y});
  }
  geometry->setVertexArray(vertices);
  geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
  geometry->setTexCoordArray(0, texcoords, osg::Array::BIND_PER_VERTEX);
  geometry->addPrimitiveSet(
      new osg::DrawElementsUShort(GL_TRIANGLES, mesh.indices.begin(), mesh.indices.end()));
  // Display lists, which are what OpenSceneGraph does unasked, are the quickest of its ways here.
  return geometry;
}

osg::ref_ptr<osg::StateSet> stateOf(const Image& image) {
  const osg::ref_ptr<osg::Image> copy = new osg::Image;
  copy->allocateImage(image.width, image.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
  std::copy(image.bytes.begin(), image.bytes.end(), copy->data());
  const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(copy);
  texture->setInternalFormat(GL_SRGB8);
  texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::LINEAR_MIPMAP_LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  const osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  state->setTextureAttribute(0, texture);
  return state;
}

osg::ref_ptr<osg::Group> sceneOf(const SceneGrid& grid) {
  const osg::ref_ptr<osg::Group> root = new osg::Group;
  const osg::ref_ptr<osg::Program> program = new osg::Program;
  program->addShader(new osg::Shader(osg::Shader::VERTEX, kVertexShader));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, kFragmentShader));
  osg::StateSet& state = *root->getOrCreateStateSet();
  state.setAttributeAndModes(program);
  state.setAttributeAndModes(new osg::CullFace);
  state.addUniform(new osg::Uniform("image", 0));
  // the camera does not turn: eye space is world space
  const glm::vec3 light = SceneGrid::kTowardsLight;
  state.addUniform(new osg::Uniform("towardsLight", osg::Vec3(light.x, light.y, light.z)));

  std::vector<osg::ref_ptr<osg::Geometry>> geometries;
  for (const auto& mesh : grid.meshes) geometries.push_back(geometryOf(*mesh));
  std::vector<osg::ref_ptr<osg::StateSet>> materials;
  for (const auto& image : grid.images) materials.push_back(stateOf(*image));
  for (const SceneGrid::Item& item : grid.items) {
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrix(&item.place[0][0]));
    place->setStateSet(materials[item.material]);
    place->addChild(geometries[item.mesh]);
    root->addChild(place);
  }
  return root;
}

class OsgScene : public Side {
 public:
  explicit OsgScene(const SceneGrid& grid) {
    viewer_.setThreadingModel(osgViewer::ViewerBase::SingleThreaded);
    const osg::ref_ptr<osgViewer::GraphicsWindowEmbedded> window =
        viewer_.setUpViewerAsEmbeddedInWindow(0, 0, SceneGrid::kPicture, SceneGrid::kPicture);
    viewer_.setSceneData(sceneOf(grid));
    osg::Camera& camera = *viewer_.getCamera();
    camera.setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera.setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
    camera.setClearColor(osg::Vec4(0, 0, 0, 1));
    camera.setProjectionMatrixAsPerspective(glm::degrees(SceneGrid::kFieldOfView), 1.0, 1.0, 400.0);
    makeFramebuffer();
    window->setDefaultFboId(framebuffer_);
    viewer_.realize();
  }

  ~OsgScene() override { context_.makeCurrent(); }

  void makeCurrent() override { context_.makeCurrent(); }

  void look(bool all) override {
    viewer_.getCamera()->setViewMatrixAsLookAt(
        osg::Vec3(0, 0, all ? SceneGrid::kDistance : SceneGrid::kNearDistance), osg::Vec3(),
        osg::Vec3(0, 1, 0));
  }

  FrameTime frame(bool discard) override {
    return timed(discard, [&] { viewer_.renderingTraversals(); });
  }

  std::vector<float> picture() override {
    makeCurrent();
    frame(false);
    std::vector<float> values(SceneGrid::kPicture * SceneGrid::kPicture * 3);
    glReadPixels(0, 0, SceneGrid::kPicture, SceneGrid::kPicture, GL_RGB, GL_FLOAT, values.data());
    return values;
  }

 private:
  /// The same formats as weft::RenderTarget's.
  void makeFramebuffer() {
    GLuint images[2];
    glCreateTextures(GL_TEXTURE_2D, 2, images);
    glTextureStorage2D(images[0], 1, GL_RGBA16F, SceneGrid::kPicture, SceneGrid::kPicture);
    glTextureStorage2D(images[1], 1, GL_DEPTH_COMPONENT32F, SceneGrid::kPicture, SceneGrid::kPicture);
    glCreateFramebuffers(1, &framebuffer_);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, images[0], 0);
    glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, images[1], 0);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  }

  CompatibilityContext context_;
  osgViewer::Viewer viewer_;
  GLuint framebuffer_ = 0;
};

}  // namespace

std::unique_ptr<Side> makeOsgScene(const SceneGrid& grid) {
  return std::make_unique<OsgScene>(grid);
}

}  // namespace weft::bench
