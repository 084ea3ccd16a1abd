#include "ViewerPanel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <glm/ext/vector_float3.hpp>

namespace weft {
namespace {

struct KeyHelp {
  const char* key;
  const char* does;
};

constexpr std::array kKeys{
    KeyHelp{"left drag", "orbit"},
    KeyHelp{"middle drag, Shift + left drag", "pan"},
    KeyHelp{"wheel", "zoom"},
    KeyHelp{"right drag, L + left drag", "move the light over its dome"},
    KeyHelp{"F", "frame all of the scene"},
    KeyHelp{"1  2  3", "cloth, sphere, plane (of a material alone)"},
    KeyHelp{"T", "turntable: start, stop"},
    KeyHelp{"S", "screenshot: weft-view-001.png and on, in the current folder"},
    KeyHelp{"R", "read the file again (it is watched, too)"},
    KeyHelp{"Tab", "hide the panel, show it"},
    KeyHelp{"H, F1", "this help"},
    KeyHelp{"Ctrl + Q", "quit"},
};

constexpr const char* kLogarithmic = "%.2f";

bool combo(const char* label, const char* shown, const std::vector<std::string>& names, std::string& chosen) {
  if (!ImGui::BeginCombo(label, shown)) return false;
  bool changed = false;
  for (const std::string& name : names)
    if (ImGui::Selectable(name.c_str(), name == shown)) {
      chosen = name;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

void drawPictureControls(ViewerState& state) {
  float exposure = state.exposure();
  if (ImGui::SliderFloat("exposure", &exposure, -6.0f, 6.0f, "%.1f stops")) state.setExposure(exposure);
  bool soft = state.toneCurve() == ToneCurve::Soft;
  if (ImGui::Checkbox("soft tone curve", &soft)) state.setToneCurve(soft ? ToneCurve::Soft : ToneCurve::None);
  std::string chosen;
  const std::string& environment = state.request().scene.environment;
  std::vector<std::string> names{"none", "studio", "sky"};
  if (!environment.empty() && environment != "studio" && environment != "sky") names.push_back(environment);
  if (combo("environment", environment.empty() ? "none" : environment.c_str(), names, chosen))
    state.setEnvironment(chosen == "none" ? "" : chosen);
  auto rotation = static_cast<float>(state.request().scene.environmentRotation);
  if (!environment.empty() && ImGui::SliderFloat("rotation", &rotation, -180.0f, 180.0f, "%.0f deg"))
    state.setEnvironmentRotation(double{rotation});
}

void drawLamps(ViewerState& state) {
  const auto& lamps = state.view()->setup.lamps();
  if (const int own = state.view()->setup.scene().lights; own > 0 && state.request().scene.lamps.empty())
    ImGui::Text("%d of the file, and", own);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    const std::string label = fmt::format("lamp {}", i + 1);
    if (ImGui::RadioButton(label.c_str(), state.selectedLamp() == i)) state.selectLamp(i);
  }
  if (ImGui::Button("add")) state.addLamp();
  ImGui::SameLine();
  if (ImGui::Button("remove")) state.removeLamp();
  if (state.selectedLamp() >= lamps.size()) return;
  glm::vec3 color = lamps[state.selectedLamp()].color;
  if (ImGui::ColorEdit3("colour", &color.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR))
    state.setLampColor(color);
}

void drawOptions(ViewerState& state, std::size_t number) {
  const BTFMaterial& material = *state.view()->fields[number].material;
  BTFMaterialOptions options = material.options();
  bool changed = false;
  float scale = options.textureScale.x;
  if (ImGui::SliderFloat("scale", &scale, 0.1f, 100.0f, kLogarithmic, ImGuiSliderFlags_Logarithmic)) {
    options.textureScale *= scale / options.textureScale.x;
    changed = true;
  }
  changed |= ImGui::ColorEdit3("tint", &options.tint.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
  bool bilinear = options.filter == TexelFilter::Bilinear;
  if (ImGui::Checkbox("filter", &bilinear)) {
    options.filter = bilinear ? TexelFilter::Bilinear : TexelFilter::Nearest;
    changed = true;
  }
  ImGui::SameLine();
  bool interpolates = options.interpolatedViews == 3;
  if (ImGui::Checkbox("between views", &interpolates)) {
    options.interpolatedViews = interpolates ? 3 : 1;
    changed = true;
  }
  bool isStochastic = options.tiling == Tiling::Stochastic;
  if (material.textures()->tilesAtRandom() && !material.map() &&
      ImGui::Checkbox("tiled at random", &isStochastic)) {
    options.tiling = isStochastic ? Tiling::Stochastic : Tiling::Repeat;
    changed = true;
  }
  if (changed) state.setOptions(number, options);
}

void drawFields(ViewerState& state) {
  const LoadedView& view = *state.view();
  for (std::size_t i = 0; i < view.fields.size(); ++i) {
    const LoadedView::Field& field = view.fields[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::Separator();
    const auto& model = field.field->model();
    ImGui::TextWrapped(
        "%s",
        fmt::format("{}: {}", field.name == "*" ? "material" : field.name, model.options().label()).c_str());
    ImGui::TextWrapped(
        "%s", fmt::format("{} x {} texels, {} views, {:.1f} MB", field.field->width(), field.field->height(),
                          field.field->description().views.size(), static_cast<double>(field.gpuBytes) / 1e6)
                  .c_str());
    if (!field.error.empty()) ImGui::TextWrapped("%s", field.error.c_str());
    drawOptions(state, i);
    ImGui::PopID();
  }
}

void drawChoices(ViewerState& state) {
  const LoadedView& view = *state.view();
  std::string chosen;
  if (!view.model.empty() && combo("model", view.model.c_str(), view.request.scene.models.names(), chosen))
    state.setModel(chosen);
  if (!view.shape.empty() && combo("on a", view.shape.c_str(), {"cloth", "sphere", "plane"}, chosen))
    state.setShape(chosen);
}

void drawRecent(ViewerState& state, const RecentFiles& recent) {
  if (recent.files().empty() || !ImGui::BeginCombo("##recent", "open a recent file")) return;
  std::filesystem::path chosen;
  for (const std::filesystem::path& file : recent.files())
    if (ImGui::Selectable(file.c_str())) chosen = file;
  ImGui::EndCombo();
  if (!chosen.empty()) state.open(chosen);
}

void drawStatus(const ViewerState& state, const ViewerPanel::Status& status) {
  std::uint64_t bytes = 0;
  if (state.view())
    for (const LoadedView::Field& field : state.view()->fields) bytes += field.gpuBytes;
  ImGui::Separator();
  ImGui::TextDisabled("%s",
                      fmt::format("{:.0f} ms a frame{}, fields {:.1f} MB", status.milliseconds,
                                  status.divisor > 1 ? " (coarse)" : "", static_cast<double>(bytes) / 1e6)
                          .c_str());
}

void drawMessages(ViewerState& state) {
  if (state.messages().empty()) return;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * screen.x, screen.y - 8.0f}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::SetNextWindowSizeConstraints({0.6f * screen.x, 0.0f}, {0.9f * screen.x, 0.5f * screen.y});
  ImGui::Begin("messages", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoNav);
  for (const std::string& message : state.messages()) ImGui::TextWrapped("%s", message.c_str());
  if (ImGui::SmallButton("dismiss")) state.clearMessages();
  ImGui::End();
}

void drawHelp() {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::Begin("help", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyHelp& key : kKeys) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key.key);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key.does);
    }
    ImGui::EndTable();
  }
  ImGui::TextDisabled("drop a file here: glTF, .rf.exr, a measurement (which is fitted), .hdr");
  ImGui::End();
}

}  // namespace

void ViewerPanel::draw(ViewerState& state, const RecentFiles& recent, const Status& status) {
  if (isOpen_) drawPanel(state, recent, status);
  if (showsHelp_) drawHelp();
  drawMessages(state);
}

void ViewerPanel::drawPanel(ViewerState& state, const RecentFiles& recent, const Status& status) {
  const float unit = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({8.0f, 8.0f}, ImGuiCond_Always);
  ImGui::SetNextWindowSizeConstraints({20.0f * unit, 0.0f},
                                      {20.0f * unit, ImGui::GetIO().DisplaySize.y - 16.0f});
  ImGui::Begin("weft-view", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  ImGui::PushItemWidth(10.0f * unit);
  drawRecent(state, recent);
  if (state.view())
    ImGui::TextWrapped("%s", state.request().file.filename().c_str());
  else if (status.doing.empty())
    ImGui::TextWrapped("Drop a file here: glTF, .rf.exr, or a measurement. H: help.");
  if (!status.doing.empty()) ImGui::TextWrapped("%s ...", status.doing.c_str());
  if (state.view()) {
    drawChoices(state);
    if (ImGui::CollapsingHeader("picture", ImGuiTreeNodeFlags_DefaultOpen)) drawPictureControls(state);
    if (ImGui::CollapsingHeader("lamps", ImGuiTreeNodeFlags_DefaultOpen)) drawLamps(state);
    if (!state.view()->fields.empty() &&
        ImGui::CollapsingHeader("measured materials", ImGuiTreeNodeFlags_DefaultOpen))
      drawFields(state);
  }
  drawStatus(state, status);
  ImGui::PopItemWidth();
  ImGui::End();
}

}  // namespace weft
