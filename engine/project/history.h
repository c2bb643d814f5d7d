// The states of a document one after the other, with a cursor that undo and redo move.
#pragma once

#include <string>
#include <vector>

#include "engine/project/command.h"
#include "engine/project/document.h"

namespace patchlab {

class History {
 public:
  const Document& document() const { return states_[position_]; }
  bool can_undo() const { return position_ > 0; }
  bool can_redo() const { return position_ < labels_.size(); }
  const std::vector<std::string>& labels() const { return labels_; }  // oldest first
  std::size_t position() const { return position_; }                  // how many of them stand

  // The document after a command, Undo and Redo too; nothing changes yet. Fills in the command as apply()
  // does.
  Result<Document> after(Command& command, const ApplyOptions& options) const;
  // Makes it the current one; what could be redone is forgotten where the command is new.
  void keep(const Command& command, Document after);

 private:
  std::vector<Document> states_ = std::vector<Document>(1);
  std::vector<std::string> labels_;
  std::size_t position_ = 0;
};

}  // namespace patchlab
