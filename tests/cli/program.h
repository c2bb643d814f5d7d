// Runs the built program in a folder of its own.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace patchlab {

struct Outcome {
  int status;
  std::string out, err;

  // One line on standard error: the sentence that a refusal owes.
  bool one_sentence() const;
};

class Program : public testing::Test {
 protected:
  Program();
  ~Program() override;

  // Arguments as a shell takes them; `input` is its standard input.
  Outcome patchlab(const std::string& arguments, const std::string& input = {}) const;

  std::filesystem::path at(const std::string& file) const { return folder_ / file; }
  std::string text(const std::string& file) const;
  std::string write(const std::string& file, const std::string& text) const;  // gives the file back
  nlohmann::json json(const std::string& text) const;

  // The path of a file of the contracts or scans beside the checkout; empty where they are absent.
  static std::filesystem::path shared(const std::string& file);

 private:
  std::filesystem::path folder_;
};

// 200 points of a ball of radius 0.1 m one metre before the sensor, with the covariances of 1 mm noise.
std::string ball_table();
// Points with x = 0 .. n - 1 on the x axis.
std::string line_table(int n);

}  // namespace patchlab
