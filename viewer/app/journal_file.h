// Where journals lie, and what is done with a journal file as a whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/project/session.h"
#include "viewer/panel/view_state.h"

namespace patchlab::viewer {

// $XDG_STATE_HOME/patchlab, or ~/.local/state/patchlab.
std::filesystem::path default_journal_folder();

// A name that is not taken, for the journal of a scan that is opened now: "<scan>-20260102-140211.patchlab".
// Makes the folder.
Result<std::filesystem::path> new_journal_path(const std::filesystem::path& folder,
                                               const std::filesystem::path& scan);

// The journals of a folder in which more was done than opening a scan, newest first, `most` of them.
std::vector<EarlierWork> earlier_work(const std::filesystem::path& folder, std::size_t most);

// Whether a file lies directly in a folder, whatever links lead there.
bool lies_in(const std::filesystem::path& file, const std::filesystem::path& folder);

// How a scan's file is named in a journal: relative to it; absolute where there is no journal.
std::string path_for_journal(const std::filesystem::path& scan, const std::filesystem::path& journal);

// A journal elsewhere: the same lines, the scans named as they are seen from there.
Result<void> copy_journal(const std::filesystem::path& journal, const std::filesystem::path& copy);

// A journal's document and history without a hold on the file: for a picture of it.
Result<Session> replayed_session(const std::filesystem::path& journal, const Progress& progress);

// The camera of the last lasso of a journal, where there is one.
std::optional<ViewCamera> last_lasso_camera(const std::filesystem::path& journal);

// Writes the kept patches, or those of the chosen map, in an export format.
Result<void> export_patches(const Document& document, const std::filesystem::path& journal,
                            const ExportRequest& request);

}  // namespace patchlab::viewer
