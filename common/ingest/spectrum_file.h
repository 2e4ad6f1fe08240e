#pragma once

#include <span>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "common/ingest/spectrum_record.h"

/// Measured and modelled spectra out of the files in which they are published, plain or gzip:
///
///   NDBC real time    41010.data_spec with .swdir, .swdir2, .swr1, .swr2 beside it
///   NDBC historical   41010w2019.txt.gz with d, i, j, k in place of w beside it; or 1-D
///   WAVEWATCH III     ASCII point spectra
///   SWAN              spectral files, 2-D or 1-D
///
/// Of NDBC's files any one is named; the others are found by their names, with or without ".gz".
/// The format is told by the first line. The directional files of NDBC may be absent: the records
/// are then 1-D.
namespace onesea::ingest {

/// Records in order of time, those of one time in the file's order. Those without energy are left
/// out; at least one is returned. NotFound: no such file (also: the density file that belongs to a
/// directional one). InvalidArgument: with file, line, field, value and limit. Files larger than
/// kReadFileBytesMax, also when unpacked, are refused.
absl::StatusOr<std::vector<SpectrumRecord>> ReadSpectrumFile(const std::string& path);

/// The same from memory. The first file is the one that was named; of the others those that belong
/// to it by name (NDBC) are used.
absl::StatusOr<std::vector<SpectrumRecord>> ParseSpectrum(std::span<const NamedBytes> files);

/// The record of a time ("2019-02-10T05:40"; empty: the only time there is) and place (empty: the
/// only one). NotFound with the nearest times, or the places; InvalidArgument if `time` is no time.
/// Points into `records`.
absl::StatusOr<const SpectrumRecord*> FindRecord(std::span<const SpectrumRecord> records,
                                                 absl::string_view time_utc,
                                                 absl::string_view place = {});

}  // namespace onesea::ingest
