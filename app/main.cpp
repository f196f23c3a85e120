#include "app/program.h"

int main(int argc, char** argv) { return morula::app::run_program(argc, argv); }
