#pragma once
#include <memory>
#include <string>

#include "app/console.h"
#include "app/options.h"
#include "core/parallel/comm.h"
#include "core/result.h"
#include "coupling/laws.h"

namespace morula::app {

/// What every verb is given.
struct Context {
  Comm comm;  ///< all ranks of the program
  Console console;
  std::string command;                                ///< as typed, for run.json
  std::shared_ptr<const Laws> laws = builtin_laws();  ///< that studies may name
};

/// The verbs. An error without text has been told already; its kind gives the exit code. `run`, `resume` and `calibrate` are collective; the others are
/// called on the root alone.
Status make_new(const NewOptions& options, const Context& context);
Status check(const CheckOptions& options, const Context& context);
Status run(const RunOptions& options, const Context& context);
Status resume(const ResumeOptions& options, const Context& context);
Status show_status(const StatusOptions& options, const Context& context);
Status list(const ListOptions& options, const Context& context);
Status info(const InfoOptions& options, const Context& context);
Status explain(const ExplainOptions& options, const Context& context);
Status plot(const PlotOptions& options, const Context& context);
Status export_results(const ExportOptions& options, const Context& context);
Status verify(const VerifyOptions& options, const Context& context);
Status compare(const CompareOptions& options, const Context& context);
Status calibrate(const CalibrateOptions& options, const Context& context);
Status doctor(const DoctorOptions& options, const Context& context);

}  // namespace morula::app
