// SPDX-License-Identifier: BSD-3-Clause
// Sheets of Excel workbooks (.xlsx) as text, by workbook.py and openpyxl. (Debian has no library for C++ that reads
// them.)
#pragma once
#include <string>
#include <string_view>

namespace drivers {

/// Whether the bytes of a file are those of a workbook (a ZIP archive); an error, which asks to save it anew, for the
/// older .xls.
bool is_workbook(std::string_view bytes, const std::string& file);

/// One sheet: a line for each row, cells between commas, texts in quotes, numbers with a decimal point. Without the
/// name of a sheet there must be one only that holds anything. Errors are std::runtime_error, one line.
std::string workbook_text(const std::string& file, const std::string& sheet);

} // namespace drivers
