"""What happens along a curve: peaks, folds and changes of stability, located."""
