#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"
#include "report/methods.h"
#include "report/pictures/standard_pictures.h"
#include "results/run_record.h"

namespace morula::scenarios {

/// One criterion of verdict.json.
struct ReportCriterion {
  std::string id;     ///< "S18.2"
  std::string text;   ///< what is asked
  std::string value;  ///< with unit
  std::string limit;  ///< "< 5 µm"
  bool passed = false;
};

/// A number that sums the run up.
struct ReportNumber {
  std::string name, value, unit;
};

/// A limit of the study against the worst value of the run: volume error, overlap, field balance.
struct ReportLimit {
  std::string name;
  double worst = 0.0, limit = 0.0;
  std::string unit;
  double when = -1.0;  ///< time of the worst value [s]; negative: not known
};

/// What exchanges of bodies of one kind did to the neighbours.
struct ReportExchanges {
  std::string kind;  ///< "promotion"
  std::size_t count = 0;
  double room = 0.0;                             ///< of all [µm³]
  double largest_force = 0.0, mean_force = 0.0;  ///< change of the force on a neighbour [nN]
  std::size_t measured = 0;                      ///< of how many the forces and jumps are known
  double largest_own_way = 0.0;                  ///< of the cell itself, at once [R]
  std::size_t settled = 0;                       ///< of how many the ways of neighbours are known
  double largest_way = 0.0, mean_way = 0.0;      ///< of a neighbour [R]
};

/// How often one kind of event happened.
struct ReportEvents {
  std::string kind;  ///< "divisions"
  std::size_t count = 0;
  double first = 0.0, last = 0.0;  ///< [s]
};

/// A plot as inline SVG: curves_svg(…, SvgUse::kInline).
struct ReportPlot {
  std::string caption;  ///< empty where the plot's own title says enough
  std::string svg;
  bool numerics = false;  ///< about steps and solver: below a fold
};

/// A table of texts under a heading of its own.
struct ReportTable {
  std::string title, note;  ///< note: a sentence below the title; may be empty
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// Everything report.html says: plain data, filled in from a run folder.
struct ReportContent {
  std::string title, study, scenario, summary;
  std::string state;  ///< "done", "stopped early", "failed"; not "done" is shown as a warning
  std::vector<ReportCriterion> criteria;
  std::vector<NotChecked> not_checked;  ///< what a reader of the criteria must not take for granted
  std::vector<ReportNumber> key_numbers;
  std::vector<ReportTable> tables;
  std::vector<EncodedPicture> pictures;
  std::vector<ReportPlot> plots;
  std::vector<ReportLimit> limits;
  std::vector<ReportEvents> events;
  std::vector<ReportExchanges> exchanges;
  std::vector<std::pair<double, std::string>> warnings;         ///< time [s], text
  std::vector<std::pair<std::string, std::string>> provenance;  ///< version, command, ranks, threads, seed, wall time, host …
  std::vector<UsedLaw> laws;
  std::string study_text, parameters_text;  ///< the study as given, and with every default
  std::string citation, bibtex;             ///< how to cite this version
};

/// The report as one self-contained HTML page (well-formed XML as well): pictures as base64, curves inline, nothing fetched; the only
/// script is that of the slider over the frames. Criteria of a library study are its verdict, those of a user's study numerical checks.
/// Follows the reader's light or dark setting, and prints all frames. All text is escaped; the SVG of plots is taken as it is.
std::string report_html(const ReportContent& content);

/// report_html to a file, which is replaced only when all is written.
Status write_report(const ReportContent& content, const std::filesystem::path& path);

/// Base64 of RFC 4648, section 4.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace morula::scenarios
