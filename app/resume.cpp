#include "app/verbs.h"
namespace morula::app {
Status resume(const ResumeOptions&, const Context&) { return {}; }
Status plot(const PlotOptions&, const Context&) { return {}; }
}
