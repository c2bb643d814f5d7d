// The commands about maps, robots and frames: what each does to a document, and how it is written.
#pragma once

#include "engine/io/json.h"
#include "engine/project/command.h"

namespace patchlab {

// As apply() of engine/project/command.h.
Result<void> run(OpenMap& open, Document& document, const ApplyOptions& options);
Result<void> run(OpenRobot& open, Document& document, const ApplyOptions& options);
Result<void> run(SetJoint& set, Document& document, const ApplyOptions& options);
Result<void> run(Place& place, Document& document, const ApplyOptions& options);
Result<void> run(Merge& merge, Document& document, const ApplyOptions& options);

void read(const JsonPlace& place, OpenMap& open);
void read(const JsonPlace& place, OpenRobot& open);
void read(const JsonPlace& place, SetJoint& set);
void read(const JsonPlace& place, Place& put);
void read(const JsonPlace& place, Merge& merge);

nlohmann::ordered_json write(const OpenMap& open);
nlohmann::ordered_json write(const OpenRobot& open);
nlohmann::ordered_json write(const SetJoint& set);
nlohmann::ordered_json write(const Place& put);
nlohmann::ordered_json write(const Merge& merge);

}  // namespace patchlab
