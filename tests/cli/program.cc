#include "tests/cli/program.h"

#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "engine/base/random.h"

namespace patchlab {
namespace fs = std::filesystem;

bool Outcome::one_sentence() const {
  return std::ranges::count(err, '\n') == 1 && err.ends_with(".\n") && out.empty();
}

Program::Program() {
  std::string pattern = (fs::temp_directory_path() / "patchlab_cli_XXXXXX").string();
  folder_ = ::mkdtemp(pattern.data());
}

Program::~Program() { fs::remove_all(folder_); }

Outcome Program::patchlab(const std::string& arguments, const std::string& input) const {
  write(".in", input);
  const std::string command =
      "cd '" + folder_.string() + "' && { '" PATCHLAB_PROGRAM "' " + arguments + "; } <.in >.out 2>.err";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text(".out"), text(".err")};
}

std::string Program::text(const std::string& file) const {
  std::ifstream stream(at(file), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string Program::write(const std::string& file, const std::string& text) const {
  std::ofstream(at(file), std::ios::binary) << text;
  return file;
}

nlohmann::json Program::json(const std::string& text) const {
  nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  EXPECT_FALSE(value.is_discarded()) << text;
  return value;
}

fs::path Program::shared(const std::string& file) {
  const fs::path path = fs::path(PATCHLAB_SOURCE_DIR).parent_path() / "shared" / file;
  return fs::exists(path) ? path : fs::path();
}

std::string ball_table() {
  constexpr double radius = 0.1, sigma = 1e-3;
  Random random(17);
  std::string table = "x,y,z,cxx,cxy,cxz,cyy,cyz,czz\n";
  for (int i = 0; i < 200; ++i) {
    const double rho = 0.07 * std::sqrt(random.uniform()), angle = random.uniform(0.0, 6.283);
    const Eigen::Vector3d on_ball(rho * std::cos(angle), rho * std::sin(angle),
                                  1.0 - std::sqrt(radius * radius - rho * rho));
    const Eigen::Vector3d q = on_ball + sigma * random.normal3();
    for (const double coordinate : {q.x(), q.y(), q.z()}) table += std::to_string(coordinate) + ",";
    table += "1e-6,0,0,1e-6,0,1e-6\n";
  }
  return table;
}

std::string line_table(int n) {
  std::string table = "x,y,z\n";
  for (int i = 0; i < n; ++i) table += std::to_string(i) + ",0,0\n";
  return table;
}

}  // namespace patchlab
