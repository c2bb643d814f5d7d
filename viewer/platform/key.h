// Codes of keys, the same on every platform: the index into ImGuiIO::KeysDown and the argument of
// ImGui::IsKeyPressed. Letters, digits and signs are the characters of an American keyboard in upper case:
// 'L', '1', '[', ' '.
#pragma once

namespace patchlab::viewer::key {

inline constexpr int escape = 256, enter = 257, tab = 258, backspace = 259, insert = 260, del = 261;
inline constexpr int right = 262, left = 263, down = 264, up = 265;
inline constexpr int page_up = 266, page_down = 267, home = 268, end = 269;
inline constexpr int f1 = 290, f2 = 291, f3 = 292, f4 = 293, f5 = 294, f11 = 300, f12 = 301;
inline constexpr int pad_0 = 320, pad_subtract = 333, pad_add = 334, pad_enter = 335;
inline constexpr int left_shift = 340, left_control = 341, left_alt = 342;
inline constexpr int right_shift = 344, right_control = 345, right_alt = 346;

}  // namespace patchlab::viewer::key
