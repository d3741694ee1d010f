"""Pictures of results: functions that draw on axes they are given."""
