#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "common/ingest/spectrum_file.h"
#include "common/ingest/utc_time.h"

namespace onesea::ingest {
namespace {

constexpr std::size_t kListedMax = 5;

std::vector<std::string> DistinctTimes(std::span<const SpectrumRecord> records) {
  std::vector<std::string> times;
  for (const SpectrumRecord& record : records) {
    if (times.empty() || times.back() != record.time_utc) times.push_back(record.time_utc);
  }
  return times;
}

std::string Range(const std::vector<std::string>& times) {
  return absl::StrCat(times.size(), " times from ", times.front(), " to ", times.back());
}

std::int64_t SecondsOf(const std::string& time_utc) {
  const std::optional<CivilTime> time = ParseUtc(time_utc);
  return time ? UnixSeconds(*time) : 0;
}

absl::Status NoSuchTime(const std::string& wanted, std::vector<std::string> times) {
  const std::string range = Range(times);
  const std::int64_t wanted_s = SecondsOf(wanted);
  std::stable_sort(times.begin(), times.end(), [&](const std::string& a, const std::string& b) {
    return std::abs(SecondsOf(a) - wanted_s) < std::abs(SecondsOf(b) - wanted_s);
  });
  times.resize(std::min(times.size(), kListedMax));
  std::sort(times.begin(), times.end());
  return absl::NotFoundError(absl::StrCat(
      "time: no record at ", wanted, "; nearest: ", absl::StrJoin(times, ", "), " (", range, ")"));
}

// The record among those of one time.
absl::StatusOr<const SpectrumRecord*> ChoosePlace(std::span<const SpectrumRecord> records,
                                                  absl::string_view place) {
  if (place.empty() && records.size() == 1) return &records.front();
  std::vector<std::string> places;
  for (const SpectrumRecord& record : records) {
    if (!place.empty() && record.place == place) return &record;
    if (places.size() < kListedMax) places.push_back(absl::StrCat("'", record.place, "'"));
  }
  const std::string listed =
      absl::StrCat(records.size(), " of them, beginning with ", absl::StrJoin(places, ", "));
  if (place.empty()) {
    return absl::NotFoundError(absl::StrCat("place: must be given; there are ", listed));
  }
  return absl::NotFoundError(absl::StrCat("place: none is '", place, "'; there are ", listed));
}

}  // namespace

absl::StatusOr<const SpectrumRecord*> FindRecord(std::span<const SpectrumRecord> records,
                                                 absl::string_view time_utc,
                                                 absl::string_view place) {
  if (records.empty()) return absl::NotFoundError("time: there is no record");
  const std::vector<std::string> times = DistinctTimes(records);
  std::string wanted = times.front();
  if (!time_utc.empty()) {
    const std::optional<CivilTime> time = ParseUtc(time_utc);
    if (!time) {
      return absl::InvalidArgumentError(
          absl::StrCat("time: '", time_utc, "' is not of the form 2019-02-10T05:40"));
    }
    wanted = *FormatUtc(*time);
  } else if (times.size() > 1) {
    return absl::NotFoundError(absl::StrCat("time: must be given; there are ", Range(times)));
  }
  const auto [begin, end] = std::equal_range(
      records.begin(), records.end(), SpectrumRecord{wanted, {}, {}, {}, {}, {}, {}},
      [](const SpectrumRecord& a, const SpectrumRecord& b) { return a.time_utc < b.time_utc; });
  if (begin == end) return NoSuchTime(wanted, times);
  return ChoosePlace(std::span(begin, end), place);
}

}  // namespace onesea::ingest
