"""The two-blade rig: its tables, layout, faces and the problem they make."""
