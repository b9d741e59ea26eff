// Two palettes and a type scale, put into ImGui's style.
#include "ui/desktop/look/theme.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/drawing/link_families.h"

namespace bl::desktop {

namespace {

constexpr ImU32 rgb(unsigned hex) { return 0xff000000u | ((hex & 0xffu) << 16) | (hex & 0xff00u) | ((hex >> 16) & 0xffu); }

constexpr Colours kDark = {.window = rgb(0x16181d),
                           .panel = rgb(0x1d2027),
                           .raised = rgb(0x2a2e38),
                           .sunken = rgb(0x12141a),
                           .line = rgb(0x343945),
                           .text = rgb(0xe6e8ec),
                           .text_soft = rgb(0xa3a9b6),
                           .text_faint = rgb(0x6b7280),
                           .accent = rgb(0x5b9dff),
                           .accent_soft = rgb(0x2a3d5c),
                           .on_accent = rgb(0x0b1220),
                           .good = rgb(0x4fb58f),
                           .warning = rgb(0xe0a63a),
                           .bad = rgb(0xe5695f),
                           .canvas = rgb(0x171a20),
                           .grid = rgb(0x20242c),
                           .grid_strong = rgb(0x272c36),
                           .node = rgb(0x242832),
                           .node_head = rgb(0x2f3542),
                           .sky = rgb(0x20252e),
                           .ground = rgb(0x2b313b)};

constexpr Colours kLight = {.window = rgb(0xe9eaed),
                            .panel = rgb(0xf7f7f8),
                            .raised = rgb(0xffffff),
                            .sunken = rgb(0xe2e4e9),
                            .line = rgb(0xd0d4db),
                            .text = rgb(0x1d2129),
                            .text_soft = rgb(0x565e6c),
                            .text_faint = rgb(0x8b93a1),
                            .accent = rgb(0x1f66d1),
                            .accent_soft = rgb(0xd5e3fa),
                            .on_accent = rgb(0xffffff),
                            .good = rgb(0x1f8a63),
                            .warning = rgb(0xa96f00),
                            .bad = rgb(0xc23b31),
                            .canvas = rgb(0xf0f1f4),
                            .grid = rgb(0xe4e6eb),
                            .grid_strong = rgb(0xd8dbe2),
                            .node = rgb(0xffffff),
                            .node_head = rgb(0xe9ecf2),
                            .sky = rgb(0xe4e9f0),
                            .ground = rgb(0xd3d7de)};

// Of kinds and parts that have no colour of their own, after Paul Tol's qualitative schemes (2021). Uses have theirs: use_tone.
constexpr std::array<unsigned, 9> kCategories = {0xeeaa66, 0x6d9fd4, 0xda7a85, 0x5fb594, 0xecd77d,
                                                 0xaa93c7, 0xb3be56, 0x92d1e4, 0xc1beb9};

// Sizes in points of the scale, ratio about 1.2.
constexpr float kSmall = 12, kBody = 14, kTitle = 17, kDisplay = 30;
constexpr std::array<float, 8> kCanvasSizes = {9, 12, 15, 19, 24, 32, 44, 60};

constexpr const char* kFolders[] = {"/usr/share/fonts/opentype/inter/", "/usr/share/fonts/truetype/dejavu/"};
constexpr const char* kRegular[] = {"Inter-Regular.otf", "DejaVuSans.ttf"};
constexpr const char* kStrong[] = {"Inter-SemiBold.otf", "DejaVuSans-Bold.ttf"};
constexpr const char* kIcons = "/usr/share/fonts-font-awesome/fonts/fontawesome-webfont.ttf";

// Latin with all of its accents, punctuation, units (m², m³, ×, ≤), arrows and Greek.
constexpr ImWchar kRanges[] = {0x20,   0x24f,  0x2b0,  0x2ff,  0x370,  0x3ff,  0x2010, 0x205e, 0x2070, 0x209c,
                               0x20a0, 0x20bf, 0x2190, 0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};
constexpr ImWchar kCanvasRanges[] = {0x20, 0x17f, 0x2010, 0x2044, 0x2070, 0x2083, 0x2190, 0x2193, 0x2264, 0x2265, 0};
constexpr ImWchar kIconRange[] = {0xf000, 0xf2e0, 0};

std::string found(const std::string& folder, const char* file) {
  std::error_code ignored;
  const std::string path = folder + file;
  return std::filesystem::exists(path, ignored) ? path : std::string();
}

ImVec4 vec(ImU32 colour) { return ImGui::ColorConvertU32ToFloat4(colour); }

}  // namespace

ImU32 faded(ImU32 colour, float opacity) {
  const auto alpha = static_cast<ImU32>(std::clamp(opacity, 0.0f, 1.0f) * static_cast<float>(colour >> 24));
  return (colour & 0x00ffffffu) | (alpha << 24);
}

ImU32 mixed(ImU32 a, ImU32 b, float share) {
  ImU32 out = 0;
  for (int shift = 0; shift < 32; shift += 8) {
    const float x = static_cast<float>((a >> shift) & 0xff), y = static_cast<float>((b >> shift) & 0xff);
    out |= static_cast<ImU32>(std::lround(x + (y - x) * std::clamp(share, 0.0f, 1.0f))) << shift;
  }
  return out;
}

std::string Theme::load_fonts(float scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.Flags |= ImFontAtlasFlags_NoPowerOfTwoHeight;
  atlas.TexDesiredWidth = 4096;
  fonts_ = {};
  std::string regular, strong;
  for (int k = 0; k < 2 && regular.empty(); ++k) {
    regular = found(kFolders[k], kRegular[k]);
    strong = found(kFolders[k], kStrong[k]);
  }
  const std::string icons = found("", kIcons);
  auto add = [&](const std::string& path, float size, const ImWchar* ranges, bool with_icons) {
    if (path.empty()) return atlas.AddFontDefault();
    ImFontConfig config;
    config.OversampleH = size * scale > 24 ? 1 : 2;
    ImFont* font = atlas.AddFontFromFileTTF(path.c_str(), std::round(size * scale), &config, ranges);
    if (with_icons && !icons.empty()) {
      ImFontConfig merged;
      merged.MergeMode = true;
      merged.GlyphOffset.y = std::round(size * scale * 0.06f);
      atlas.AddFontFromFileTTF(icons.c_str(), std::round(size * scale * 0.95f), &merged, kIconRange);
    }
    return font;
  };
  fonts_.body = add(regular, kBody, kRanges, true);
  fonts_.small = add(regular, kSmall, kRanges, true);
  fonts_.strong = add(strong.empty() ? regular : strong, kBody, kRanges, true);
  fonts_.title = add(strong.empty() ? regular : strong, kTitle, kRanges, false);
  fonts_.display = add(strong.empty() ? regular : strong, kDisplay, kCanvasRanges, false);
  for (const float size : kCanvasSizes) fonts_.canvas.push_back(add(regular, size, kCanvasRanges, false));
  atlas.Build();
  if (regular.find("inter") != std::string::npos) return "";
  return "The packaged typeface (fonts-inter) is missing; another one is used.";
}

ImFont* Theme::canvas_font(float pixels) const {
  for (ImFont* font : fonts_.canvas)
    if (font->FontSize >= pixels - 0.5f) return font;
  return fonts_.canvas.back();
}

namespace {

// In points, at scale 1.
void set_measures(ImGuiStyle& style) {
  style.WindowPadding = {12, 10};
  style.FramePadding = {8, 5};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.ScrollbarSize = 11;
  style.GrabMinSize = 10;
  style.WindowRounding = 6;
  style.ChildRounding = 0;
  style.FrameRounding = 4;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 6;
  style.GrabRounding = 4;
  style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.ChildBorderSize = 0;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 1;
}

void set_colours(ImGuiStyle& style, const Colours& c) {
  auto set = [&](ImGuiCol index, ImU32 colour) { style.Colors[index] = vec(colour); };
  set(ImGuiCol_Text, c.text);
  set(ImGuiCol_TextDisabled, c.text_faint);
  set(ImGuiCol_WindowBg, c.panel);
  set(ImGuiCol_ChildBg, 0);
  set(ImGuiCol_PopupBg, c.raised);
  set(ImGuiCol_Border, c.line);
  set(ImGuiCol_FrameBg, c.sunken);
  set(ImGuiCol_FrameBgHovered, mixed(c.sunken, c.accent, 0.14f));
  set(ImGuiCol_FrameBgActive, mixed(c.sunken, c.accent, 0.24f));
  set(ImGuiCol_TitleBg, c.panel);
  set(ImGuiCol_TitleBgActive, c.raised);
  set(ImGuiCol_MenuBarBg, c.window);
  set(ImGuiCol_ScrollbarBg, 0);
  set(ImGuiCol_ScrollbarGrab, mixed(c.panel, c.text_faint, 0.45f));
  set(ImGuiCol_ScrollbarGrabHovered, c.text_faint);
  set(ImGuiCol_ScrollbarGrabActive, c.text_soft);
  set(ImGuiCol_CheckMark, c.accent);
  set(ImGuiCol_SliderGrab, c.accent);
  set(ImGuiCol_SliderGrabActive, c.accent);
  // Buttons have a face on panels and on what is raised above them.
  set(ImGuiCol_Button, mixed(c.raised, c.text, 0.1f));
  set(ImGuiCol_ButtonHovered, mixed(c.raised, c.accent, 0.3f));
  set(ImGuiCol_ButtonActive, mixed(c.raised, c.accent, 0.45f));
  set(ImGuiCol_Header, c.accent_soft);
  set(ImGuiCol_HeaderHovered, mixed(c.panel, c.accent, 0.2f));
  set(ImGuiCol_HeaderActive, mixed(c.panel, c.accent, 0.32f));
  set(ImGuiCol_Separator, c.line);
  set(ImGuiCol_SeparatorHovered, c.accent);
  set(ImGuiCol_SeparatorActive, c.accent);
  set(ImGuiCol_ResizeGrip, 0);
  set(ImGuiCol_Tab, c.panel);
  set(ImGuiCol_TabHovered, mixed(c.panel, c.accent, 0.25f));
  set(ImGuiCol_TabActive, c.raised);
  set(ImGuiCol_PlotLines, c.accent);
  set(ImGuiCol_TableHeaderBg, c.raised);
  set(ImGuiCol_TableBorderStrong, c.line);
  set(ImGuiCol_TableBorderLight, faded(c.line, 0.6f));
  set(ImGuiCol_TableRowBg, 0);
  set(ImGuiCol_TableRowBgAlt, faded(c.text, 0.025f));
  set(ImGuiCol_TextSelectedBg, faded(c.accent, 0.35f));
  set(ImGuiCol_DragDropTarget, c.accent);
  set(ImGuiCol_NavHighlight, c.accent);
  set(ImGuiCol_ModalWindowDimBg, faded(rgb(0x000000), 0.45f));
}

}  // namespace

void Theme::apply(bool is_dark, float scale) {
  is_dark_ = is_dark;
  scale_ = std::clamp(scale, 1.0f, 2.0f);
  colours_ = is_dark ? kDark : kLight;
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_measures(style);
  style.ScaleAllSizes(scale_);
  set_colours(style, colours_);
}

Family Theme::family_of(const LinkDefinition* kind) const {
  const drawing::FamilyInk* ink = drawing::ink_of(kind == nullptr ? LinkFamily::other : kind->family);
  if (ink == nullptr) return {"the brief and the boundary", is_dark_ ? rgb(0xc9a227) : rgb(0x8a6a00)};
  const unsigned hex = static_cast<unsigned>(std::stoul(std::string(ink->colour.substr(1)), nullptr, 16));
  // The report's inks are made for paper; on a dark ground they are lightened.
  return {ink->label, is_dark_ ? mixed(rgb(hex), rgb(0xffffff), 0.38f) : rgb(hex)};
}

const char* sign_of(Icon icon) {
  switch (icon) {
    case Icon::link: return icon::kLink;
    case Icon::file: return icon::kFile;
    case Icon::balance: return icon::kBalance;
    case Icon::cycle: return icon::kReset;
    case Icon::cube: return icon::kCube;
    case Icon::plus: return icon::kPlus;
    case Icon::step: return icon::kStep;
  }
  return icon::kLink;
}

ImU32 Theme::category(std::size_t k) const {
  const ImU32 tone = rgb(kCategories[k % kCategories.size()]);
  return mixed(tone, rgb(0x2b334a), std::min(0.6f, 0.3f * static_cast<float>(k / kCategories.size())));
}

ImU32 Theme::ramp(double t) {
  // Support points of a ramp of even lightness steps from blue over green to yellow, after the cividis scheme (Nuñez, Anderton
  // and Renslow 2018), which reads the same with and without colour deficiency.
  constexpr std::array<unsigned, 7> kPoints = {0x00224e, 0x35456c, 0x666970, 0x8a8778, 0xb0a473, 0xd7c461, 0xfee838};
  const double at = std::clamp(t, 0.0, 1.0) * (kPoints.size() - 1);
  const auto k = std::min<std::size_t>(static_cast<std::size_t>(at), kPoints.size() - 2);
  return mixed(rgb(kPoints[k]), rgb(kPoints[k + 1]), static_cast<float>(at - static_cast<double>(k)));
}

ImU32 Theme::diverging(double t) const {
  const ImU32 middle = is_dark_ ? rgb(0xcfd3da) : rgb(0xf2f2f2);
  return mixed(middle, t < 0 ? rgb(0x2f6fb7) : rgb(0xb8552b), static_cast<float>(std::abs(std::clamp(t, -1.0, 1.0))));
}

ImU32 colour_of_text(const std::string& text, ImU32 otherwise) {
  if (text.size() != 7 || text[0] != '#' || text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
    return otherwise;
  const unsigned long all = std::stoul(text.substr(1), nullptr, 16);
  return IM_COL32(all >> 16 & 0xffu, all >> 8 & 0xffu, all & 0xffu, 255);
}

}  // namespace bl::desktop
