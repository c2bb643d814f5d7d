#include "engine/io/point_table.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "engine/io/read_error.h"
#include "engine/io/read_scan.h"
#include "engine/io/scan_from_columns.h"
#include "engine/io/text_numbers.h"

namespace patchlab {
namespace {

constexpr std::size_t rows_between_progress = 1 << 16;
constexpr char blank = ' ';  // as a separator: any number of spaces and tabs
constexpr std::array<std::string_view, 3> coordinates = {"x", "y", "z"};

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

std::string column_name(std::string_view cell) {
  const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  return lower_case(quoted ? cell.substr(1, cell.size() - 2) : cell);
}

using Names = std::vector<std::string>;

Names column_names(std::string_view header) {
  std::vector<std::string_view> cells;
  split(header, separator_of(header), cells);
  Names names;
  std::ranges::transform(cells, std::back_inserter(names), column_name);
  return names;
}

bool is_header(std::string_view line) {
  const Names names = column_names(line);
  return std::ranges::all_of(
      coordinates, [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); });
}

bool are_numbers(std::string_view line) {
  std::vector<std::string_view> cells;
  split(line, separator_of(line), cells);
  if (cells.size() < coordinates.size()) return false;
  cells.resize(coordinates.size());
  return std::ranges::all_of(cells,
                             [](std::string_view cell) { return parse_number<double>(cell).has_value(); });
}

// Without the # or // before it; nothing where the line is no comment.
std::optional<std::string_view> comment(std::string_view line) {
  line = trimmed(line);
  if (line.starts_with("//")) return trimmed(line.substr(2));
  if (line.starts_with('#')) return trimmed(line.substr(1));
  return std::nullopt;
}

// Where the rows begin: at a header row, which may stand in a comment, or at the first row itself. PTS files
// say how many rows follow in a line of its own.
struct Start {
  std::optional<std::string_view> header = {};
  std::string_view row = {};  // the first row, where there is no header
  std::optional<std::uint64_t> promised = {};
};

std::optional<Start> find_start(LineReader& lines) {
  Start start;
  while (const auto line = lines.next()) {
    const auto text = comment(*line);
    if (is_header(text.value_or(*line))) {
      start.header = text.value_or(*line);
      return start;
    }
    if (text || trimmed(*line).empty()) continue;
    if (!start.promised && (start.promised = parse_number<std::uint64_t>(trimmed(*line)))) continue;
    start.row = *line;
    return start;
  }
  return std::nullopt;
}

// What is known of the columns: which cells of a row are kept, by their index, and what the scan calls them.
struct Table {
  char separator = blank;
  bool headed = true;
  Names names;
  std::vector<std::size_t> kept;
  std::vector<double> values;  // of the kept cells, row after row
};

std::string list(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

Result<Table> table_under(std::string_view header, std::size_t number, Scan& scan) {
  Table table{separator_of(header), true, column_names(header), {}, {}};
  Names left_out;
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    const std::string& name = table.names[i];
    if (!is_point_table_column(name)) {
      left_out.push_back(name);
      continue;
    }
    if (std::ranges::count(table.names, name) > 1) {
      return unreadable_line(scan.file, number, "names column " + shown(name) + " twice.");
    }
    table.kept.push_back(i);
    scan.fields.push_back({name, "float64", 1});
  }
  if (!left_out.empty())
    scan.notices.push_back("Columns without a meaning here were left out: " + list(left_out) + ".");
  return table;
}

Result<Table> table_without_header(std::string_view row, std::size_t number, Scan& scan) {
  std::vector<std::string_view> cells;
  const char separator = separator_of(row);
  Table table{separator == '\t' ? blank : separator, false, {}, {}, {}};
  split(row, table.separator, cells);
  if (!are_numbers(row)) {
    return unreadable_line(
        scan.file, number,
        "is neither a header row that names the columns x, y and z, as in 'x,y,z', nor a row "
        "of three numbers or more.");
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool coordinate = i < coordinates.size();
    table.names.push_back(coordinate ? std::string(coordinates[i]) : std::to_string(i + 1));
    if (!coordinate) continue;
    table.kept.push_back(i);
    scan.fields.push_back({table.names[i], "float64", 1});
  }
  std::string notice = "The table has no header row: its first three columns are taken as x, y and z";
  if (cells.size() > coordinates.size()) notice += "; the columns after them were left out";
  scan.notices.push_back(notice + ".");
  return table;
}

Result<void> parse_row(const std::vector<std::string_view>& cells, std::size_t line, const std::string& file,
                       Table& table) {
  if (cells.size() != table.names.size()) {
    return unreadable_line(file, line,
                           "has " + std::to_string(cells.size()) + " columns where " +
                               (table.headed ? "the header row" : "the first row") + " has " +
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
    if (trimmed(*line).empty() || comment(*line)) continue;
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

// Files that lie beside depth images and look like tables of few points.
std::string_view matrix_kind(const Table& table) {
  if (table.headed) return "";
  const std::vector<double>& v = table.values;
  const std::size_t width = table.names.size(), rows = v.size() / 3;
  if (width == 3 && rows == 3 && v[6] == 0.0 && v[7] == 0.0 && v[8] == 1.0)
    return "a matrix of 3 x 3 numbers and no points; give it as --intrinsics beside a depth image.";
  if (width == 4 && rows == 4 && v[9] == 0.0 && v[10] == 0.0 && v[11] == 0.0)
    return "a matrix of 4 x 4 numbers, the pose of a camera perhaps, and no points.";
  return "";
}

}  // namespace

bool is_point_table(std::string_view bytes) {
  LineReader lines(bytes);
  const std::optional<Start> start = find_start(lines);
  return start && (start->header || are_numbers(start->row));
}

Result<Scan> read_point_table(std::string_view bytes, const std::string& name, const ReadOptions& options) {
  Scan scan;
  scan.file = name;
  scan.format = "csv";
  scan.encoding = "ascii";
  LineReader lines(bytes);
  const std::optional<Start> start = find_start(lines);
  if (!start)
    return unreadable(name, "holds no rows of numbers; a point table starts with a header row, as 'x,y,z'.");
  Result<Table> table = start->header ? table_under(*start->header, lines.number(), scan)
                                      : table_without_header(start->row, lines.number(), scan);
  if (!table) return table.error();
  if (!start->header)
    lines =
        LineReader(bytes.substr(static_cast<std::size_t>(start->row.data() - bytes.data())), lines.number());
  if (const auto read = parse_rows(lines, scan, options, *table); !read) return read.error();
  if (const std::string_view what = matrix_kind(*table); !what.empty())
    return unreadable(name, "holds " + std::string(what));

  const std::size_t points = table->values.size() / table->kept.size();
  if (start->promised && *start->promised != points) {
    return unreadable(name, "its first line promises " + std::to_string(*start->promised) + " points, but " +
                                std::to_string(points) + " follow; the file is cut off or no point table.");
  }
  const std::size_t step = table->kept.size() * sizeof(double);
  const char* first = reinterpret_cast<const char*>(table->values.data());
  std::vector<Column> columns;
  for (const FieldInfo& field : scan.fields) {
    columns.push_back({field.name, Scalar::float64, 1, first, step});
    first += sizeof(double);
  }
  scan.width = static_cast<std::uint32_t>(points);
  scan.notices.push_back(std::string("A point table states no viewpoint").append(at_the_origin));
  const auto filled = fill_scan(scan, columns, points, OriginRule::always, options);
  if (!filled) return filled.error();
  return scan;
}

}  // namespace patchlab
