// onesea spectrum: the words of the command; its work is in spectrum_command.

#include "client/app/cli_commands.h"
#include "client/app/spectrum_command.h"

namespace onesea::app {
namespace {

absl::Status RunSpectrumWords(const CliContext& context, const Arguments& arguments) {
  SpectrumOptions options;
  options.path = arguments.operands()[0];
  options.time = arguments.Get("time").value_or("");
  options.place = arguments.Get("place").value_or("");
  options.png_path = arguments.Get("png").value_or("");
  options.json = context.json;
  return FileError(RunSpectrum(options, context.out));
}

}  // namespace

CliCommand SpectrumCommand() {
  return {.name = "spectrum",
          .operands = "FILE",
          .operand_count = 1,
          .summary = "tells what a spectrum file holds; needs no server",
          .details =
              "NDBC (any one of the five files of a station), WAVEWATCH III and SWAN; compressed\n"
              "or not. Directions are nautical, where waves come from. JSON keys: time, place,\n"
              "format, hs_m, tp_s, tm02_s, mean_direction_deg, spread_deg.",
          .options = {{"time", "TIME", "one record, as 2019-02-10T05:40 UTC; default all"},
                      {"place", "NAME", "one place of a file with several"},
                      {"png", "OUT", "draw the polar plot of the one record"}},
          .examples = {"onesea spectrum deploy/sessions/41010/41010w2019part.txt.gz",
                       "onesea spectrum deploy/sessions/41010/41010w2019part.txt.gz --time "
                       "2019-02-10T05:40 --png build/storm.png",
                       "onesea spectrum deploy/sessions/41010/41010w2019part.txt.gz --json"},
          .run = RunSpectrumWords};
}

}  // namespace onesea::app
