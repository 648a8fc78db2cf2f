// SPDX-License-Identifier: Apache-2.0
// Points per second of reading and of writing each file format, as a ratio to plainly reading and
// writing as many bytes, both in one run. See README.md.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "comparison.h"
#include "core/error.h"
#include "core/temporary_path.h"
#include "record/formats.h"
#include "record/open_source.h"
#include "scan/point.h"

namespace {

using namespace plotscan;
namespace fs = std::filesystem;

using Points = std::vector<scan::LabelledPoint>;

constexpr std::size_t kBuffer_bytes = std::size_t{256} * 1024;  // of plain reading and writing

void read_plainly(const fs::path& file) {
  std::array<char, kBuffer_bytes> buffer;
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  check(descriptor >= 0, "cannot open " + file.string());
  while (read(descriptor, buffer.data(), buffer.size()) > 0) benchmark::ClobberMemory();
  close(descriptor);
}

void write_plainly(const fs::path& file, std::uintmax_t bytes) {
  std::array<char, kBuffer_bytes> buffer{};
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  check(descriptor >= 0, "cannot create " + file.string());
  while (bytes > 0) {
    const auto piece = static_cast<std::size_t>(std::min<std::uintmax_t>(bytes, buffer.size()));
    const ssize_t written = write(descriptor, buffer.data(), piece);
    check(written > 0, "cannot write " + file.string());
    bytes -= static_cast<std::uintmax_t>(written);
  }
  close(descriptor);
}

// The flight that the files are written of, and its points.
struct Flight {
  explicit Flight(const fs::path& scan_folder) : source(record::open_source(scan_folder, {})) {
    source.stream([&](std::span<const scan::LabelledPoint> piece) {
      points.insert(points.end(), piece.begin(), piece.end());
    });
  }
  record::Source source;
  Points points;
};

// A way of writing a format.
struct Kind {
  const record::Format* format = nullptr;
  std::string encoding;

  std::string name() const {
    return format->extensions.front() + (encoding.empty() ? "" : ", " + encoding);
  }
};

std::vector<Kind> written_kinds() {
  std::vector<Kind> kinds;
  for (const record::Format& format : record::formats()) {
    if (!format.create) continue;
    if (format.encodings.empty()) kinds.push_back({&format, ""});
    for (const std::string& encoding : format.encodings) kinds.push_back({&format, encoding});
  }
  return kinds;
}

void write_as(const Kind& kind, const Flight& flight, const fs::path& file) {
  constexpr std::size_t kTogether = 16384;
  const auto writer = kind.format->create(file, flight.source, {.encoding = kind.encoding});
  const std::span<const scan::LabelledPoint> points(flight.points);
  for (std::size_t i = 0; i < points.size(); i += kTogether)
    writer->write(points.subspan(i, std::min(kTogether, points.size() - i)));
  writer->close();
}

// As other programs write clouds as text: x, y and z alone.
void write_text(const Flight& flight, const fs::path& file) {
  std::ofstream out(file);
  for (const scan::LabelledPoint& point : flight.points)
    out << fmt::format("{:.3f} {:.3f} {:.3f}\n", point.x, point.y, point.z);
  out.close();
  check(out.good(), "cannot write " + file.string());
}

std::size_t read_points(const fs::path& file, const record::SourceOptions& options) {
  std::size_t points = 0;
  record::open_source(file, options).stream([&](std::span<const scan::LabelledPoint> piece) {
    points += piece.size();
  });
  return points;
}

void add_reading(const std::string& name, const Flight& flight, const fs::path& file,
                 const record::SourceOptions& options) {
  const std::size_t points = read_points(file, options);
  check(points == flight.points.size(),
        fmt::format("{} holds {} of {} points", name, points, flight.points.size()));
  speed::add_benchmark("reading " + name,
                       {.ours = [=] { benchmark::DoNotOptimize(read_points(file, options)); },
                        .reference = [=] { read_plainly(file); },
                        .reference_name = "its bytes alone",
                        .items = "points",
                        .count = static_cast<double>(points),
                        .bytes = static_cast<double>(fs::file_size(file))});
}

void add_writing(const Kind& kind, const Flight& flight, const fs::path& file) {
  const std::uintmax_t bytes = fs::file_size(file);
  const fs::path folder = file.parent_path();
  const fs::path ours = folder / ("ours" + file.extension().string());
  const fs::path plain = folder / "plain";
  // Into new files: where one is written over, file systems hurry to bring it to the disk.
  const auto remove_both = [=] {
    fs::remove(ours);
    fs::remove(plain);
  };
  speed::add_benchmark("writing " + kind.name(),
                       {.ours = [=, &flight] { write_as(kind, flight, ours); },
                        .reference = [=] { write_plainly(plain, bytes); },
                        .prepare = remove_both,
                        .reference_name = "as many bytes alone",
                        .items = "points",
                        .count = static_cast<double>(flight.points.size()),
                        .bytes = static_cast<double>(bytes)});
}

// The options needed to read a recording that has no poses of its own.
record::SourceOptions reading_options(const record::Format& format, const fs::path& scan_folder) {
  if (!format.is_recording || format.has_topics) return {};
  return {.flight = record::FlightOptions{.trajectory = scan_folder / "poses.csv"}};
}

int run(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: format_speed SCAN [--benchmark_...]\n";
    return 2;
  }
  const fs::path scan_folder = argv[1];
  const Flight flight(scan_folder);
  const TemporaryPath folder(fs::temp_directory_path() /
                             ("format_speed-" + std::to_string(getpid())));
  fs::create_directory(folder.path());
  const std::vector<Kind> kinds = written_kinds();
  for (const Kind& kind : kinds) {
    const fs::path file =
        folder.path() / ("flight" + kind.encoding + kind.format->extensions.front());
    write_as(kind, flight, file);
    if (kind.format->open)
      add_reading(kind.name(), flight, file, reading_options(*kind.format, scan_folder));
    add_writing(kind, flight, file);
  }
  const fs::path text = folder.path() / "cloud.xyz";
  write_text(flight, text);
  add_reading(".xyz", flight, text, {});
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return plotscan::speed::run_program("format_speed", run, argc, argv);
}
