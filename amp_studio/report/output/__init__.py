"""The formats of a report: PDF, web page, text, table, workbook, JSON."""
