#include "engine/project/history.h"

namespace patchlab {

Result<Document> History::after(Command& command, const ApplyOptions& options) const {
  const bool undo = std::holds_alternative<Undo>(command), redo = std::holds_alternative<Redo>(command);
  if (!undo && !redo) return apply(document(), command, options);
  if (undo && !can_undo()) return Error{ErrorCode::refused, "There is nothing to undo."};
  if (redo && !can_redo()) return Error{ErrorCode::refused, "There is nothing to redo."};
  return undo ? states_[position_ - 1] : states_[position_ + 1];
}

void History::keep(const Command& command, Document after) {
  if (std::holds_alternative<Undo>(command)) {
    --position_;
  } else if (std::holds_alternative<Redo>(command)) {
    ++position_;
  } else {
    labels_.resize(position_);
    states_.resize(position_ + 1);
    labels_.push_back(describe(command, after));
    states_.push_back(std::move(after));
    ++position_;
  }
}

}  // namespace patchlab
