"""Import questionnaires from survey programs: XLSForm, REDCap, LimeSurvey and Qualtrics."""
