"""Files of results: netCDF 3, of which those of marches grow; tables and pictures."""
