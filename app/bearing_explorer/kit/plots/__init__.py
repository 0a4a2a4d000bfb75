"""The look of figures: colours, axes, ranges, the heat map."""
