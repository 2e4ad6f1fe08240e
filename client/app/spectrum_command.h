#pragma once

#include <iosfwd>
#include <string>

#include "absl/status/status.h"

/// `onesea spectrum FILE`: what a spectrum file holds. Needs no server.
namespace onesea::app {

struct SpectrumOptions {
  std::string path;
  std::string time;   ///< "2019-02-10T05:40"; empty: all records, or the only one
  std::string place;  ///< of files with several; empty: all, or the only one
  bool json = false;
  std::string png_path;  ///< where to draw the polar plot of the one record; empty: nowhere
};

/// Prints Hs, Tp, Tm02, direction (nautical, coming from) and spread of one record, or a table with
/// a line for each. JSON: an object, or an array of objects when neither a time nor a place is
/// given and there are several records:
///
///   {"time":"2019-02-10T05:40","place":"41010","format":"...","hs_m":4.71,"tp_s":10,
///    "tm02_s":7.7,"mean_direction_deg":42.8,"spread_deg":33.8}
///
/// Directions of 1-D spectra are null. `time` is null where the file has none.
///
/// NotFound: no such file, time (the nearest are listed) or place. InvalidArgument: from the
/// reader, or a picture of several records is asked for. Unavailable: the picture can't be written.
absl::Status RunSpectrum(const SpectrumOptions& options, std::ostream& out);

}  // namespace onesea::app
