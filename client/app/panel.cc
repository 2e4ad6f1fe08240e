#include "client/app/panel.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace onesea::client {
namespace {

constexpr double kMPerSInAKnot = 1852.0 / 3600.0;

void ShowSource(const SourceReport& report, double frames_per_second) {
  ImGui::TextWrapped("%s", report.where.c_str());
  ImGui::Text("link       %s", report.link.c_str());
  if (!report.trouble.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(1.0f, 0.6f, 0.3f, 1.0f));
    ImGui::TextWrapped("%s", report.trouble.c_str());
    ImGui::PopStyleColor();
  }
  ImGui::Text("tick       %lld  (speed %.2f)", static_cast<long long>(report.tick), report.speed);
  if (report.drift_m >= 0) {
    ImGui::Text("drift      %.3g mm", 1000.0 * report.drift_m);
  } else {
    ImGui::TextUnformatted("drift      -");
  }
  if (report.clock_error_s >= 0) {
    ImGui::Text("clock      +- %.3f ms", 1000.0 * report.clock_error_s);
  } else {
    ImGui::TextUnformatted("clock      own");
  }
  ImGui::Text("pictures   %.1f per second", frames_per_second);
}

void ShowSea(const SeaFigures& figures) {
  ImGui::TextWrapped("%s", figures.name.c_str());
  ImGui::Text("Hs %.2f m   Tp %.1f s   wind %.1f m/s", figures.hs_m, figures.tp_s,
              figures.wind_speed_m_per_s);
  if (figures.density_m2_per_hz.empty()) return;
  ImGui::SetNextItemWidth(-1.0f);
  ImGui::PlotLines(
      "##spectrum", figures.density_m2_per_hz.data(),
      static_cast<int>(figures.density_m2_per_hz.size()), 0, "m2/Hz, 0 to 0.6 Hz", 0.0f,
      1.05f * *std::max_element(figures.density_m2_per_hz.begin(), figures.density_m2_per_hz.end()),
      ImVec2(0, 80));
}

// From the middle to either side, [-1, 1].
void Bar(const char* label, double value) {
  ImGui::Text("%-9s %3d %%", label, static_cast<int>(std::lround(100.0 * std::abs(value))));
  ImGui::SameLine();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetTextLineHeight());
  const float middle = from.x + 0.5f * size.x,
              end = middle + 0.5f * size.x * static_cast<float>(value);
  ImDrawList* const list = ImGui::GetWindowDrawList();
  list->AddRectFilled(from, ImVec2(from.x + size.x, from.y + size.y),
                      ImGui::GetColorU32(ImGuiCol_FrameBg));
  list->AddRectFilled(ImVec2(std::min(middle, end), from.y),
                      ImVec2(std::max(middle, end) + 1.0f, from.y + size.y),
                      ImGui::GetColorU32(ImGuiCol_PlotHistogram));
  ImGui::Dummy(size);
}

// At the foot of the picture, whether the panel is open or not.
void ShowHelm(const HelmReport& helm) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos(ImVec2(size.x * 0.5f, size.y - 12.0f), ImGuiCond_Always,
                          ImVec2(0.5f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(std::min(420.0f, size.x - 24.0f), 0));
  ImGui::SetNextWindowBgAlpha(0.6f);
  ImGui::Begin("Helm", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
  if (helm.aboard) {
    ImGui::Text("boat %u    %.1f m/s  (%.1f kn)", helm.boat, helm.speed_m_per_s,
                helm.speed_m_per_s / kMPerSInAKnot);
    Bar("throttle", helm.throttle);
    Bar("rudder", -helm.rudder);  // to the right turns to the right
  }
  if (!helm.line.empty()) ImGui::TextWrapped("%s", helm.line.c_str());
  ImGui::End();
}

void Slider(const char* label, double& value, double low, double high, const char* format) {
  ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &low, &high, format);
}

void ShowSettings(ViewSettings& settings) {
  Slider("sun height", settings.sun_elevation_deg, -8.0, 90.0, "%.1f deg");
  Slider("sun bearing", settings.sun_azimuth_deg, 0.0, 360.0, "%.0f deg");
  Slider("clouds", settings.cloud_cover, 0.0, 1.0, "%.2f");
  Slider("visibility", settings.visibility_km, 1.0, 80.0, "%.0f km");
  Slider("exposure", settings.exposure_stops, -4.0, 4.0, "%+.1f stops");
  ImGui::Combo("water", &settings.water, "I\0IB\0II\0III\0001C\0003C\0005C\0");
}

void ShowKeys() {
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x * 0.5f, 40), ImGuiCond_Always,
                          ImVec2(0.5f, 0));
  ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::TextUnformatted(
      "W A S D      fly (Shift: faster)\n"
      "Q E          down, up\n"
      "mouse drag   look around\n"
      "wheel        zoom; distance when circling\n"
      "O            circle a point / fly\n"
      "B            launch a boat ahead\n"
      "arrows       its throttle and rudder\n"
      "C            camera behind the boat / free\n"
      "Space        drop a crate\n"
      "X            set off an explosion ahead, under water\n"
      "Delete       take the boat out of the water\n"
      "[ ]          sun lower, higher\n"
      "P            save a picture\n"
      "Tab          panel on, off\n"
      "H            this list\n"
      "Esc          quit");
  ImGui::End();
}

}  // namespace

Panel::Panel() {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the viewer writes no file that nobody asked for
  ImGui::StyleColorsDark();
  ImGui::GetStyle().WindowRounding = 4.0f;
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Panel::~Panel() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui::DestroyContext();
}

void Panel::Draw(int width, int height, double seconds, const Pointer& pointer,
                 const SourceReport& report, const SeaFigures& figures, const HelmReport& helm,
                 ViewSettings& settings) {
  const double rate = 1.0 / std::max(seconds, 1e-4);
  frames_per_second_ += 0.1 * (rate - frames_per_second_);
  const bool show_helm = helm.aboard || !helm.line.empty();
  if (!settings.show_panel && !settings.show_keys && !show_helm) return;
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = ImVec2(static_cast<float>(width), static_cast<float>(height));
  io.DeltaTime = static_cast<float>(std::max(seconds, 1e-4));
  io.MousePos = ImVec2(pointer.x, pointer.y);
  io.MouseDown[0] = pointer.pressed;
  io.MouseWheel = pointer.wheel;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  if (settings.show_panel) {
    ImGui::SetNextWindowPos(ImVec2(12, 12), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(300, 0), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowBgAlpha(0.72f);
    ImGui::Begin("Onesea  (H: keys)");
    ShowSea(figures);
    ImGui::Separator();
    ShowSource(report, frames_per_second_);
    ImGui::Separator();
    ShowSettings(settings);
    ImGui::End();
  }
  if (show_helm) ShowHelm(helm);
  if (settings.show_keys) ShowKeys();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Panel::WantsPointer() const { return ImGui::GetIO().WantCaptureMouse; }

}  // namespace onesea::client
