"""Linear structures, condensed onto what their contacts see, order by order."""
