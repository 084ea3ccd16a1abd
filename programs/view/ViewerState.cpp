#include "ViewerState.h"

#include <algorithm>

#include <utility>

#include "LightDome.h"

namespace weft {
namespace {

constexpr std::size_t kMostMessages = 6;
constexpr std::size_t kMostLamps = 256;  // that can be drawn, with the lights of a file

LightDome domeOf(const LoadedView& view) {
  const Bounds& bounds = view.setup.scene().bounds;
  return {bounds.center(), 4.0 * (bounds.radius() > 0.0 ? bounds.radius() : 1.0)};
}

bool isSameScene(const LoadedView& a, const LoadedView& b) {
  return a.request.file == b.request.file && a.shape == b.shape;
}

}  // namespace

ViewerState::ViewerState(ViewRequest first, float exposure, std::optional<ToneCurve> toneCurve)
    : request_(std::move(first)), exposure_(exposure), toneCurve_(toneCurve) {
  if (!request_.file.empty()) reload();
}

void ViewerState::open(const std::filesystem::path& file) {
  if (ViewRequest::kindOf(file) == ViewedKind::Environment) return setEnvironment(file.string());
  ViewRequest next = request_;
  next.file = file;
  next.model.clear();
  // What was asked for of the scene before does not suit another.
  next.scene.materialFiles.clear();
  next.scene.mapFiles.clear();
  next.scene.cameraName.clear();
  next.scene.viewpoint.reset();
  next.scene.lamps.clear();
  next.scene.time.reset();
  next.scene.animation.clear();
  requested_ = std::move(next);
}

std::optional<ViewRequest> ViewerState::takeRequest() {
  if (requested_) requested_->scene.aspect = aspect_;
  return std::exchange(requested_, std::nullopt);
}

void ViewerState::show(Result<LoadedView> loaded) {
  changed();
  if (!loaded) return tell(loaded.error().message());
  for (const std::string& warning : loaded->warnings) tell(warning);
  const bool same = view_ && isSameScene(*view_, *loaded);
  if (same) {
    keepFrom(*view_, *loaded);
  } else {
    ownLamps_ = false;
    turn_ = 0.0;
    selectedLamp_ = 0;
  }
  view_ = std::move(*loaded);
  request_ = view_->request;
  if (same) return view_->setup.turn(turn_);
  camera_.lookAs(view_->setup.camera(), view_->setup.scene().bounds);
  if (view_->fromFront) camera_.frame(view_->setup.root(), aspect_, {0, 0, 1});
}

// What people have changed stays when the same is loaded once more.
void ViewerState::keepFrom(LoadedView& before, LoadedView& next) const {
  if (ownLamps_) next.setup.setLamps(before.setup.lamps());
  next.request.scene.environmentRotation = request_.scene.environmentRotation;
  next.setup.turnEnvironment(request_.scene.environmentRotation);
  for (LoadedView::Field& field : next.fields) {
    const auto old = std::ranges::find(before.fields, field.name, &LoadedView::Field::name);
    if (old == before.fields.end()) continue;
    BTFMaterialOptions options = field.material->options();
    const BTFMaterialOptions& kept = old->material->options();
    options.textureScale *= kept.textureScale / old->firstScale;
    options.tint = kept.tint;
    options.filter = kept.filter;
    options.interpolatedViews = kept.interpolatedViews;
    static_cast<void>(field.material->setOptions(options));  // were in order before
  }
}

void ViewerState::setAspect(float aspect) {
  aspect_ = aspect;
  changed();
}

Camera ViewerState::camera() const {
  return camera_.camera(view_ ? view_->setup.scene().bounds : Bounds());
}

void ViewerState::drag(Drag what, glm::dvec2 drag) {
  if (!view_) return;
  if (what == Drag::Orbit) camera_.orbit(drag);
  if (what == Drag::Pan) camera_.pan(drag);
  if (what == Drag::Light) {
    if (view_->setup.lamps().empty()) addLamp();
    auto lamps = view_->setup.lamps();
    if (lamps.empty()) return;
    SceneOptions::Lamp& lamp = lamps[std::min(selectedLamp_, lamps.size() - 1)];
    lamp.place = domeOf(*view_).dragged(lamp.place, camera(), drag);
    setLamps(std::move(lamps));
  }
  changed();
}

void ViewerState::zoom(double steps) {
  camera_.zoom(steps);
  changed();
}

void ViewerState::frame() {
  if (!view_) return;
  camera_.frame(*view_->setup.scene().root, aspect_);
  changed();
}

void ViewerState::turnScene(double radians) {
  if (!view_) return;
  turn_ += radians;
  view_->setup.turn(turn_);
  changed();
}

void ViewerState::setLamps(std::vector<SceneOptions::Lamp> lamps) {
  ownLamps_ = true;
  view_->setup.setLamps(std::move(lamps));
  changed();
}

void ViewerState::addLamp() {
  if (!view_ ||
      view_->setup.lamps().size() + static_cast<std::size_t>(view_->setup.scene().lights) >= kMostLamps)
    return;
  auto lamps = view_->setup.lamps();
  lamps.push_back({domeOf(*view_).firstLamp(camera()), glm::vec3(1.0f)});
  selectedLamp_ = lamps.size() - 1;
  setLamps(std::move(lamps));
}

void ViewerState::removeLamp() {
  if (!view_ || view_->setup.lamps().empty()) return;
  auto lamps = view_->setup.lamps();
  selectedLamp_ = std::min(selectedLamp_, lamps.size() - 1);
  lamps.erase(lamps.begin() + static_cast<std::ptrdiff_t>(selectedLamp_));
  if (selectedLamp_ > 0) --selectedLamp_;
  setLamps(std::move(lamps));
}

void ViewerState::setLampColor(glm::vec3 color) {
  if (!view_ || selectedLamp_ >= view_->setup.lamps().size()) return;
  auto lamps = view_->setup.lamps();
  lamps[selectedLamp_].color = color;
  setLamps(std::move(lamps));
}

void ViewerState::setShape(const std::string& shape) {
  ViewRequest next = request_;
  next.shape = shape;
  const bool isScene = next.file.empty() || next.kind() == ViewedKind::Scene;
  // a scene has its own
  if (isScene && !next.file.empty() && !next.file.string().starts_with("shape:")) return;
  if (isScene) next.file = "shape:" + shape;
  requested_ = std::move(next);
}

void ViewerState::setEnvironment(const std::string& environment) {
  ViewRequest next = request_;
  if (next.file.empty()) next.file = "shape:sphere";
  next.scene.environment = environment;
  next.scene.btf.preparedForEnvironments =
      !environment.empty() && next.scene.environmentLobes == LobeLookup::Fitted;
  requested_ = std::move(next);
}

void ViewerState::setModel(const std::string& model) {
  ViewRequest next = request_;
  next.model = model;
  requested_ = std::move(next);
}

void ViewerState::setEnvironmentRotation(double degrees) {
  request_.scene.environmentRotation = degrees;
  if (view_) view_->setup.turnEnvironment(degrees);
  changed();
}

void ViewerState::setOptions(std::size_t field, const BTFMaterialOptions& options) {
  if (!view_ || field >= view_->fields.size()) return;
  if (const auto set = view_->fields[field].material->setOptions(options); !set) tell(set.error().message());
  changed();
}

void ViewerState::setExposure(float stops) {
  exposure_ = stops;
  changed();
}

ToneCurve ViewerState::toneCurve() const {
  return toneCurve_.value_or(request_.scene.environment.empty() ? ToneCurve::None : ToneCurve::Soft);
}

void ViewerState::setToneCurve(ToneCurve curve) {
  toneCurve_ = curve;
  changed();
}

void ViewerState::tell(std::string message) {
  messages_.push_back(std::move(message));
  if (messages_.size() > kMostMessages) messages_.erase(messages_.begin());
  changed();
}

}  // namespace weft
