"""Parts with dimensions: functions of Python scripts, and tables of CAD files."""
