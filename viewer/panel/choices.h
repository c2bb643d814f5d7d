// Actions that choose or switch something, as tables: what is lit in the tool bar and ticked in the menus,
// and what a key changes, are read from the same rows.
#pragma once

#include <optional>

#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

std::optional<SurfaceRequest> surface_of(Action action);
std::optional<BoundaryRequest> boundary_of(Action action);
std::optional<Reshaping> reshaping_of(Action action);
std::optional<SelectMode> mode_of(Action action);
std::optional<Tool> tool_of(Action action);
std::optional<PointColours> colours_of(Action action);
std::optional<SigmaOf> sigma_of(Action action);
bool Layers::*layer_of(Action action);  // nullptr for what is no layer

// True where the action is what is chosen now; nothing where it is not a choice.
std::optional<bool> is_chosen(Action action, const ViewState& state);
// Whether it can be done now.
bool is_possible(Action action, const Document& document, const ViewState& state);

}  // namespace patchlab::viewer
