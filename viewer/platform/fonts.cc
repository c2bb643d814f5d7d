#include "viewer/platform/fonts.h"

#include <imgui.h>

#include <cmath>

namespace patchlab::viewer {
namespace {

// Of Inter, in em: ImGui's font size is from ascender to descender, and a digit is as wide as "0".
constexpr float kLineHeight = 1.21f;
constexpr float kDigitWidth = 0.62f;

constexpr ImWchar kDigits[] = {'0', '9', 0};
constexpr ImWchar kGlyphs[] = {0x0020, 0x002F, 0x003A, 0x024F,  // Latin
                               0x0300, 0x052F,                  // Greek, Cyrillic
                               0x1E00, 0x1EFF,                  // Latin with marks
                               0x2000, 0x20BF,                  // punctuation, superscripts, currencies
                               0x2100, 0x23FF,                  // letter-like, arrows, mathematics, technical
                               0x25A0, 0x27BF,                  // geometric shapes, symbols
                               0xFFFD, 0xFFFD, 0};

ImFont* add(const font_files::Embedded& file, float em) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  const auto from_memory = [&](const ImWchar* glyphs) {
    return atlas.AddFontFromMemoryTTF(const_cast<unsigned char*>(file.bytes), static_cast<int>(file.size),
                                      kLineHeight * em, &config, glyphs);
  };
  ImFont* font = from_memory(kGlyphs);
  config.MergeMode = true;
  config.GlyphMinAdvanceX = config.GlyphMaxAdvanceX = std::round(kDigitWidth * em);
  from_memory(kDigits);
  return font;
}

}  // namespace

Fonts load_fonts(float scale) {
  ImGui::GetIO().Fonts->Clear();
  Fonts fonts{};
  fonts.body = add(font_files::Inter_Regular_otf, 13.0f * scale);
  fonts.small = add(font_files::Inter_Regular_otf, 11.0f * scale);
  fonts.heading = add(font_files::Inter_SemiBold_otf, 11.0f * scale);
  fonts.strong = add(font_files::Inter_SemiBold_otf, 13.0f * scale);
  fonts.title = add(font_files::Inter_SemiBold_otf, 15.0f * scale);
  return fonts;
}

}  // namespace patchlab::viewer
