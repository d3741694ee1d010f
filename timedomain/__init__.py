"""Time integration of the same equations with the same compiled contact laws."""
