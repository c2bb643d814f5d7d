// The JSON Schemas of assets/schema against documents.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace patchlab::test {

// A failure of the test that asks, where the file cannot be read.
nlohmann::json read_json(const std::filesystem::path& file);

nlohmann::json schema_json(const std::string& name);

// What the schema of that name says against a document; empty where it accepts it.
std::string complaints(const std::string& schema_name, const nlohmann::json& document);

}  // namespace patchlab::test
