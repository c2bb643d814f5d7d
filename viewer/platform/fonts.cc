#include "viewer/platform/fonts.h"

#include <imgui.h>
#include <imgui_freetype.h>

#include <cmath>

namespace patchlab::viewer {
namespace {

// Of Inter, in em: ImGui's font size is from ascender to descender, and a digit is as wide as "0".
constexpr float kLineHeight = 1.21f;
constexpr float kDigitWidth = 0.62f;

// Pairs of first and last character.
constexpr ImWchar kDigits[] = {'0', '9', 0};
constexpr ImWchar kGlyphs[] = {0x0020, 0x002F, 0x003A, 0x00FF,  // Latin
                               0x0391, 0x03C9,                  // Greek
                               0x2010, 0x2027, 0x2030, 0x203A,  // punctuation
                               0x2070, 0x208E,                  // superscripts, subscripts
                               0x2190, 0x2199,                  // arrows
                               0x2202, 0x2265,                  // mathematics
                               0x25A0, 0x25FF,                  // geometric shapes
                               0x2713, 0x2717,                  // ticks and crosses
                               0xFFFD, 0xFFFD, 0};
// More letters for the names of files, in the body font only.
constexpr ImWchar kMoreLetters[] = {0x0100, 0x017F, 0x0400, 0x045F, 0};

ImFontConfig one_of(const Embedded& file, float em) {
  ImFontConfig config;
  config.FontData = const_cast<unsigned char*>(file.bytes);
  config.FontDataSize = static_cast<int>(file.size);
  config.FontDataOwnedByAtlas = false;
  config.SizePixels = kLineHeight * em;
  return config;
}

ImFont* add(const Embedded& file, float em) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  ImFontConfig config = one_of(file, em);
  config.GlyphRanges = kGlyphs;
  ImFont* font = atlas.AddFont(&config);
  config.MergeMode = true;
  config.GlyphRanges = kDigits;
  config.GlyphMinAdvanceX = config.GlyphMaxAdvanceX = std::round(kDigitWidth * em);
  atlas.AddFont(&config);
  return font;
}

// To the font that was added last.
void add_more_letters(const Embedded& file, float em) {
  ImFontConfig config = one_of(file, em);
  config.MergeMode = true;
  config.GlyphRanges = kMoreLetters;
  ImGui::GetIO().Fonts->AddFont(&config);
}

}  // namespace

Fonts load_fonts(float scale) {
  using namespace font_files;
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
  atlas.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
  Fonts fonts{};
  fonts.body = add(Inter_Regular_otf, 13.0f * scale);
  add_more_letters(Inter_Regular_otf, 13.0f * scale);
  fonts.small = add(Inter_Regular_otf, 11.0f * scale);
  fonts.heading = add(Inter_SemiBold_otf, 11.0f * scale);
  fonts.strong = add(Inter_SemiBold_otf, 13.0f * scale);
  fonts.title = add(Inter_SemiBold_otf, 15.0f * scale);
  return fonts;
}

}  // namespace patchlab::viewer
