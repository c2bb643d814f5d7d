#include "engine/io/point_table.h"

#include <algorithm>

#include "engine/io/read_error.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t rows_between_progress = 1 << 16;
constexpr char blank = ' ';  // as a separator: any number of spaces and tabs

char separator_of(std::string_view header) {
  for (const char candidate : {';', ',', '\t'}) {
    if (header.find(candidate) != std::string_view::npos) return candidate;
  }
  return blank;
}

void split(std::string_view line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  if (separator == blank) {
    for (std::string_view word = next_word(line); !word.empty(); word = next_word(line))
      cells.push_back(word);
    return;
  }
  for (;;) {
    const std::size_t end = line.find(separator);
    cells.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

std::string_view unquoted(std::string_view cell) {
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return quoted ? cell.substr(1, cell.size() - 2) : cell;
}

std::vector<std::string_view> column_names(std::string_view header) {
  std::vector<std::string_view> names;
  split(header, separator_of(header), names);
  std::ranges::transform(names, names.begin(), unquoted);
  return names;
}

// What the header row says: which cells of a row are kept, by their index, and what the scan calls them.
struct Table {
  char separator = blank;
  std::vector<std::string_view> names;
  std::vector<std::size_t> kept;
  std::vector<double> values;  // of the kept cells, row after row
};

std::string list(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

Result<Table> parse_header(std::string_view line, std::size_t number, Scan& scan) {
  if (!is_point_table_header(line)) {
    return unreadable_line(scan.file, number,
                           "is not the header row of a point table; it must name the columns x, y and z, as "
                           "in 'x,y,z'.");
  }
  Table table{separator_of(line), column_names(line), {}, {}};
  std::vector<std::string_view> left_out;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::string_view name = table.names[i];
    if (!is_point_table_column(name)) {
      left_out.push_back(name);
      continue;
    }
    if (std::ranges::count(table.names, name) > 1) {
      return unreadable_line(scan.file, number, "names column " + shown(name) + " twice.");
    }
    table.kept.push_back(i);
    scan.fields.push_back({std::string(name), "float64", 1});
  }
  if (!left_out.empty())
    scan.notices.push_back("Columns without a meaning here were left out: " + list(left_out) + ".");
  return table;
}

Result<void> parse_row(const std::vector<std::string_view>& cells, std::size_t line, const std::string& file,
                       Table& table) {
  if (cells.size() != table.names.size()) {
    return unreadable_line(file, line,
                           "has " + std::to_string(cells.size()) + " columns where the header row has " +
                               std::to_string(table.names.size()) + ".");
  }
  for (const std::size_t i : table.kept) {
    const auto value = parse_number<double>(cells[i]);
    if (!value) {
      return unreadable_line(file, line,
                             shown(cells[i]) + " in column " + shown(table.names[i]) +
                                 " is not a number; write decimals with a point, as in 0.25.");
    }
    table.values.push_back(*value);
  }
  return {};
}

Result<void> parse_rows(LineReader& lines, const Scan& scan, const ReadOptions& options, Table& table) {
  const auto all = static_cast<double>(lines.rest().size() + 1);
  std::vector<std::string_view> cells;
  while (const auto line = lines.next()) {
    if (trimmed(*line).empty()) continue;
    split(*line, table.separator, cells);
    if (const auto parsed = parse_row(cells, lines.number(), scan.file, table); !parsed) return parsed;
    if (lines.number() % rows_between_progress != 0) continue;
    if (!keep_going(options.progress, 1.0 - static_cast<double>(lines.rest().size()) / all)) {
      return Error{ErrorCode::cancelled, scan.file + ": reading was cancelled."};
    }
    const std::uint64_t rows = table.values.size() / table.kept.size();
    if (const auto fits = check_memory(scan.file, rows, table.values.size() * sizeof(double), options); !fits)
      return fits;
  }
  if (table.values.empty()) return unreadable(scan.file, "has a header row but no points below it.");
  return {};
}

}  // namespace

bool is_point_table_header(std::string_view line) {
  const std::vector<std::string_view> names = column_names(line);
  const auto has = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  return has("x") && has("y") && has("z");
}

Result<Scan> read_point_table(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  Scan scan;
  scan.file = name;
  scan.format = "csv";
  scan.encoding = "ascii";
  LineReader lines(bytes);
  std::optional<std::string_view> header = lines.next();
  while (header && (trimmed(*header).empty() || header->front() == '#')) header = lines.next();
  if (!header) return unreadable(name, "is empty; a point table starts with a header row, as 'x,y,z'.");
  Result<Table> table = parse_header(*header, lines.number(), scan);
  if (!table) return table.error();
  if (const auto read = parse_rows(lines, scan, options, *table); !read) return read.error();

  const std::size_t points = table->values.size() / table->kept.size();
  const std::size_t step = table->kept.size() * sizeof(double);
  const char* first = reinterpret_cast<const char*>(table->values.data());
  std::vector<Column> columns;
  for (const FieldInfo& field : scan.fields) {
    columns.push_back({field.name, Scalar::float64, 1, first, step});
    first += sizeof(double);
  }
  scan.width = static_cast<std::uint32_t>(points);
  scan.notices.emplace_back(
      "A point table states no viewpoint: the sensor is taken to be at the origin, looking along +z.");
  const auto filled = fill_scan(scan, columns, points, OriginRule::always, options);
  if (!filled) return filled.error();
  return scan;
}

}  // namespace patchlab
