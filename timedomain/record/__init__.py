"""Where a march begins, what it measures and what it stores."""
