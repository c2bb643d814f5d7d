// What the document is asked about patches: their tilt, how they lie to each other, which of them are the
// same.
#include "viewer/app/app.h"

namespace patchlab::viewer {

void App::answer_questions() {
  Questions& asked = state_.questions;
  const Answered wanted{workbench_.changes(), state_.selected, asked.other, asked.limit};
  if (wanted == answered_) return;
  answered_ = wanted;
  asked.slope.reset();
  asked.relation.reset();
  asked.message.clear();
  const Document& document = workbench_.document();
  if (!find_placed(document, state_.selected)) return;
  const Eigen::Vector3d up = up_in(shown_frame(document)).direction;
  if (const Result<Slope> answer = slope(document, state_.selected, up, asked.limit)) asked.slope = *answer;
  if (!find_placed(document, asked.other)) asked.other.clear();
  if (asked.other.empty() || asked.other == state_.selected) return;
  const Result<Relation> answer = relate(document, state_.selected, asked.other);
  if (answer)
    asked.relation = *answer;
  else
    asked.message = answer.error().message;
}

// Once for each state of the document that a proposal is open in.
void App::propose() {
  Proposed& proposed = state_.proposed;
  if (proposed.view.empty() || proposed_at_ == workbench_.changes()) return;
  proposed_at_ = workbench_.changes();
  proposed.matches.reset();
  proposed.message.clear();
  workbench_.in_background([this, map = proposed.map, view = proposed.view, at = proposed_at_,
                            document = workbench_.session().document()]() -> Worker::Finish {
    auto found =
        std::make_shared<Result<MergeProposal>>(propose_merge(document, map, view, AssociateOptions{}.gate));
    return [this, map, view, at, found] {
      Proposed& now = state_.proposed;
      if (now.map != map || now.view != view || proposed_at_ != at) return;
      if (*found)
        now.matches = std::make_shared<const MergeProposal>(std::move(**found));
      else
        now.message = found->error().message;
    };
  });
}

}  // namespace patchlab::viewer
