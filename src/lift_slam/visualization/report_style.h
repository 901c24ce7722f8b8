#pragma once

namespace lift_slam {

// Style sheet of report.html apart from the plots: light, dark and print.
const char* ReportStyleSheet();

}  // namespace lift_slam
