#include "tests/support/json_schema.h"

#include <gtest/gtest.h>

#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "engine/base/file.h"

namespace patchlab::test {

nlohmann::json read_json(const std::filesystem::path& file) {
  const Result<Bytes> bytes = read_file(file);
  if (bytes) return nlohmann::json::parse(as_text(*bytes));
  ADD_FAILURE() << bytes.error().message;
  return {};
}

nlohmann::json schema_json(const std::string& name) {
  return read_json(std::filesystem::path(PATCHLAB_SOURCE_DIR) / "assets/schema" / (name + ".schema.json"));
}

std::string complaints(const std::string& schema_name, const nlohmann::json& document) {
  using Adapter = valijson::adapters::NlohmannJsonAdapter;
  const nlohmann::json rules = schema_json(schema_name);
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(rules), schema);
  valijson::ValidationResults results;
  valijson::Validator(valijson::Validator::kStrongTypes).validate(schema, Adapter(document), &results);
  std::string text;
  for (valijson::ValidationResults::Error error; results.popError(error);) {
    for (const std::string& step : error.context) text += step;
    text += ": " + error.description + "\n";
  }
  return text;
}

}  // namespace patchlab::test
