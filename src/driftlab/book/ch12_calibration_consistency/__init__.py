"""Chapter 12: is the calibration as good as it says?"""
