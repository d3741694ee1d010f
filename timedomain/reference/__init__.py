"""The reference march: average acceleration with a fixed step."""
