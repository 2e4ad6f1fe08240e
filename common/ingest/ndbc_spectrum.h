#pragma once

#include <span>
#include <vector>

#include "absl/status/statusor.h"
#include "common/ingest/ndbc_table.h"
#include "common/ingest/spectrum_record.h"

namespace onesea::ingest {

/// NDBC's five tables of one station. Only the density is required; without directions the records
/// are 1-D.
struct NdbcTables {
  NdbcTable density;
  NdbcTable mean_direction, principal_direction, r1, r2;  ///< no rows: not given
  bool is_history = false;                                ///< r1 and r2 are in hundredths
};

/// Widths by which NDBC sums its bands [Hz], one per frequency: 0.005 up to 0.0925, 0.010 up to
/// 0.35, 0.020 above where the bands are those of NDBC's 46- and 47-band systems; else from the
/// middle between neighbours to the next.
std::vector<double> NdbcBandWidths(std::span<const float> frequency_hz);

/// One record per line of the density table, in order of time, joined with the directional lines of
/// the same time.
///
/// * Lines whose bands are all missing (999) or all 0 give no record; a missing band is left out of
///   its record.
/// * A band with a missing alpha1 or r1 has no known direction: r1 = r2 = 0 (maximum entropy: all
///   round). Where only alpha2 or r2 is missing, they are those of a cos^2s distribution with this
///   r1.
/// * hs_m is 4 √Σ S Δf over NDBC's bands.
///
/// InvalidArgument naming file, line and field for what is out of range.
absl::StatusOr<std::vector<SpectrumRecord>> JoinNdbcTables(const NdbcTables& tables,
                                                           const std::string& place);

}  // namespace onesea::ingest
